#include "core/acquisition/drift_limit.h"

#include <fmt/format.h>

#include <cmath>
#include <map>

namespace zerodrift::acquisition {
namespace {

constexpr double leap_coverage = 4.0;  // standard uncertainties of a difference
constexpr int confirmations = 3;       // approaches that find the leap

}  // namespace

void DriftLimit::put(Points& points, double time_s, const std::array<double, 3>& error_um,
                     const std::array<double, 3>& sigma_um) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (std::isfinite(error_um[axis])) points[axis] = Point{time_s, error_um[axis], sigma_um[axis]};
  }
}

void DriftLimit::know(double time_s, const std::array<double, 3>& error_um, const std::array<double, 3>& sigma_um) {
  put(m_good, time_s, error_um, sigma_um);
}

std::optional<Leap> DriftLimit::leap_from(const Points& from, double time_s, const std::array<double, 3>& error_um,
                                          const std::array<double, 3>& sigma_um) const {
  std::optional<Leap> furthest;
  double most = 0.0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (!from[axis] || !std::isfinite(error_um[axis])) continue;
    const double minutes = std::abs(time_s - from[axis]->time_s) / 60.0;
    const double limit_um = m_rule.least_um + m_rule.um_per_min * minutes +
                            leap_coverage * std::hypot(sigma_um[axis], from[axis]->sigma_um);
    const double change_um = error_um[axis] - from[axis]->error_um;
    const double beyond_um = std::abs(change_um) - limit_um;
    if (beyond_um <= most) continue;
    most = beyond_um;
    furthest = Leap{std::string(1, "XYZ"[axis]), change_um, limit_um, false};
  }
  return furthest;
}

std::optional<Leap> DriftLimit::judge(double time_s, const std::array<double, 3>& error_um,
                                      const std::array<double, 3>& sigma_um) {
  std::optional<Leap> leap = leap_from(m_good, time_s, error_um, sigma_um);
  // The longer a leap is open, the more heat could have made of it: only what leaves it again ends it.
  const bool again = m_found > 0 && !leap_from(m_leapt, time_s, error_um, sigma_um);
  if (!leap && !again) {
    put(m_good, time_s, error_um, sigma_um);
    m_leapt = {};
    m_found = 0;
    return std::nullopt;
  }
  m_found = again ? m_found + 1 : 1;
  if (!again) m_first = *leap;
  leap = m_first;
  m_leapt = {};
  put(m_leapt, time_s, error_um, sigma_um);
  if (m_found < confirmations) return leap;
  leap->confirmed = true;
  put(m_good, time_s, error_um, sigma_um);
  m_leapt = {};
  m_found = 0;
  return leap;
}

HeatJudgement judge_by_heat(DriftLimit& limit, double time_s, const std::array<double, 3>& applied_um,
                            ErrorSample& measured) {
  HeatJudgement judgement;
  judgement.by_heat_um = measured.error_um;
  for (std::size_t i = 0; i < 3; ++i) {
    if (std::isfinite(applied_um[i])) judgement.by_heat_um[i] -= applied_um[i];
  }
  const auto leap = limit.judge(time_s, judgement.by_heat_um, measured.sigma_um);
  if (!leap) return judgement;
  std::map<std::string, std::string> context = {{"axis", leap->axis},
                                                {"change_um", fmt::format("{:+.1f}", leap->change_um)}};
  if (leap->confirmed) {
    judgement.slipped = Error{ErrorCode::leap_confirmed, std::move(context)};
    return judgement;
  }
  context["limit_um"] = fmt::format("{:.1f}", leap->limit_um);
  std::vector<Settled> settled = std::move(measured.settled);
  measured = not_measured({});
  measured.settled = std::move(settled);
  judgement.refused = Error{ErrorCode::error_leapt, std::move(context)};
  return judgement;
}

}  // namespace zerodrift::acquisition
