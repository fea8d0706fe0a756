#include "core/compensation/axis_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace zerodrift::compensation {
namespace {

constexpr double same_mm = 1e-9;

double mapped(const std::vector<double>& from, const std::vector<double>& to, double value) {
  if (value <= from.front()) return value + (to.front() - from.front());
  if (value >= from.back()) return value + (to.back() - from.back());
  const auto above = static_cast<std::size_t>(std::upper_bound(from.begin(), from.end(), value) - from.begin());
  const double fraction = (value - from[above - 1]) / (from[above] - from[above - 1]);
  return to[above - 1] + fraction * (to[above] - to[above - 1]);
}

}  // namespace

Result<AxisMap> AxisMap::from(const AxisTable& axis) {
  AxisMap map;
  const auto add = [&](double x, double y) {
    if (!map.m_x.empty() && std::abs(x - map.m_x.back()) < same_mm) {
      map.m_y.back() = 0.5 * (map.m_y.back() + y);  // lines that meet: equal up to rounding, else half way
    } else {
      map.m_x.push_back(x);
      map.m_y.push_back(y);
    }
  };
  for (const Segment& s : axis.segments) {
    add(s.from_mm, s.a * s.from_mm + s.b_mm);
    add(s.to_mm, s.a * s.to_mm + s.b_mm);
  }
  if (axis.segments.empty()) {
    for (const TablePoint& p : axis.points) {
      add(p.position_mm, p.position_mm + 0.5e-3 * (p.error_up_um + p.error_down_um));
    }
  }
  if (map.m_x.empty()) {
    return fail(ErrorCode::not_enough_data,
                {{"what", "segments or points of the axis"}, {"found", "0"}, {"needed", "1"}});
  }
  for (std::size_t i = 1; i < map.m_x.size(); ++i) {
    if (map.m_x[i] > map.m_x[i - 1] && map.m_y[i] > map.m_y[i - 1]) continue;
    return fail(ErrorCode::data_does_not_fit, {{"what", fmt::format("the axis table near {:g} mm", map.m_x[i])},
                                               {"found", "positions or images that fall"},
                                               {"expected", "both increasing"}});
  }
  return map;
}

double AxisMap::forward(double encoder_mm) const {
  return mapped(m_x, m_y, encoder_mm);
}

double AxisMap::inverse(double true_mm) const {
  return mapped(m_y, m_x, true_mm);
}

}  // namespace zerodrift::compensation
