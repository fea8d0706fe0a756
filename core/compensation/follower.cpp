#include "core/compensation/follower.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/compensation/sign.h"

namespace zerodrift::compensation {
namespace {

const std::array<std::string, 3> axis_names = {"X", "Y", "Z"};
constexpr double default_rate_um_s = 2.0;

}  // namespace

Temperatures Follower::held(const Temperatures& channels, FollowerOutput& output) const {
  Temperatures inside = channels;
  for (const auto& [sensor, range] : m_table.valid) {
    const auto at = inside.find(sensor);
    if (at == inside.end() || !std::isfinite(at->second)) continue;
    const double low = range.low_C - m_options.extrapolation_margin_K;
    const double high = range.high_C + m_options.extrapolation_margin_K;
    if (at->second >= low && at->second <= high) continue;
    output.mode = FollowerMode::held_at_edge;
    output.reasons.push_back(fmt::format("{} at {:.1f} C is outside the training range {:.1f} to {:.1f} C", sensor,
                                         at->second, range.low_C, range.high_C));
    at->second = std::clamp(at->second, low, high);
  }
  return inside;
}

void Follower::limit(double dt_s, const std::array<double, 3>& wanted_um, FollowerOutput& output) {
  for (std::size_t i = 0; i < 3; ++i) {
    const auto at = m_table.axes.find(axis_names[i]);
    const double rate_um_s = at == m_table.axes.end() ? default_rate_um_s : at->second.max_um_per_s;
    const double most_um = at == m_table.axes.end() ? 0.0 : at->second.max_um;
    const double step_um = std::min(rate_um_s * dt_s, m_options.largest_step_um);
    const double goal_um = std::clamp(wanted_um[i], -most_um, most_um);
    m_offset_um[i] += std::clamp(goal_um - m_offset_um[i], -step_um, step_um);
  }
  output.offset_um = m_offset_um;
}

Result<std::array<double, 3>> Follower::predict(double time_s, const Temperatures& channels,
                                                const std::map<std::string, double>& positions_mm) const {
  if (m_predictor) return m_predictor(time_s, channels);
  std::array<double, 3> predicted_um{};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto position = positions_mm.find(axis_names[i]);
    const double x = position == positions_mm.end() ? 0.0 : position->second;
    ZD_TRY(predicted_um[i], error_um(m_table, axis_names[i], x, Approach::up, channels));
  }
  return predicted_um;
}

FollowerOutput Follower::step(double time_s, const Temperatures& channels,
                              const std::map<std::string, double>& positions_mm) {
  FollowerOutput output;
  const double dt_s = m_time_s ? std::max(0.0, time_s - *m_time_s) : 0.0;
  m_time_s = time_s;
  std::array<double, 3> wanted_um{};
  const auto predicted = predict(time_s, held(channels, output), positions_mm);
  if (predicted) {
    output.predicted_um = *predicted;
    for (std::size_t i = 0; i < 3; ++i) wanted_um[i] = compensation_from_error_um((*predicted)[i]);
  } else {
    output.mode = FollowerMode::safe_zero;
    output.reasons.push_back(describe(predicted.error()));
  }
  limit(dt_s, wanted_um, output);
  return output;
}

double Follower::slowest_rate_um_s() const {
  std::optional<double> slowest_um_s;
  for (const auto& [name, axis] : m_table.axes) {
    slowest_um_s = std::min(slowest_um_s.value_or(axis.max_um_per_s), axis.max_um_per_s);
  }
  return slowest_um_s.value_or(default_rate_um_s);
}

}  // namespace zerodrift::compensation
