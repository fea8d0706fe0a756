#include "core/compensation/positioning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace zerodrift::compensation {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double mean_of(const std::vector<double>& values) {
  if (values.empty()) return none;
  double sum = 0.0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

double deviation_of(const std::vector<double>& values) {
  if (values.size() < 2) return none;
  const double mean = mean_of(values);
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(values.size() - 1));
}

/// Extremes of values that are there; NaN when one of them is not, because a figure of a part would look too good.
class Range {
 public:
  void add(double value) {
    if (!std::isfinite(value)) m_broken = true;
    m_low = std::min(m_low, value);
    m_high = std::max(m_high, value);
    m_any = true;
  }
  double width() const { return usable() ? m_high - m_low : none; }
  double high() const { return usable() ? m_high : none; }

 private:
  bool usable() const { return m_any && !m_broken; }
  double m_low = std::numeric_limits<double>::infinity();
  double m_high = -std::numeric_limits<double>::infinity();
  bool m_any = false;
  bool m_broken = false;
};

std::vector<TargetFigures> targets_of(const LaserReport& report) {
  std::vector<std::array<std::vector<double>, 2>> values(report.targets_mm.size());
  for (const auto& one : report.readings) {
    values[one.target][one.approach == Approach::up ? 0 : 1].push_back(one.deviation_um);
  }
  std::vector<TargetFigures> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [up, down] = values[i];
    TargetFigures t;
    t.target_mm = report.targets_mm[i];
    t.runs_up = static_cast<int>(up.size());
    t.runs_down = static_cast<int>(down.size());
    t.mean_up_um = mean_of(up);
    t.mean_down_um = mean_of(down);
    t.s_up_um = deviation_of(up);
    t.s_down_um = deviation_of(down);
    t.reversal_um = t.mean_up_um - t.mean_down_um;
    out.push_back(t);
  }
  return out;
}

void iso_230_2(PositioningFigures& f) {
  Range mean_up, mean_down, mean_both, mean_mean, reach_up, reach_down, reach_both, r_up, r_down, r_both, b;
  double b_sum = 0.0;
  for (const auto& t : f.targets) {
    mean_up.add(t.mean_up_um);
    mean_down.add(t.mean_down_um);
    mean_mean.add(0.5 * (t.mean_up_um + t.mean_down_um));
    for (const double value : {t.mean_up_um, t.mean_down_um}) mean_both.add(value);
    for (const double sign : {-2.0, 2.0}) {
      const double up = t.mean_up_um + sign * t.s_up_um;
      const double down = t.mean_down_um + sign * t.s_down_um;
      reach_up.add(up);
      reach_down.add(down);
      reach_both.add(up);
      reach_both.add(down);
    }
    r_up.add(4.0 * t.s_up_um);
    r_down.add(4.0 * t.s_down_um);
    const double bidirectional = 2.0 * t.s_up_um + 2.0 * t.s_down_um + std::abs(t.reversal_um);
    r_both.add(std::max({bidirectional, 4.0 * t.s_up_um, 4.0 * t.s_down_um}));
    b.add(std::abs(t.reversal_um));
    b_sum += t.reversal_um;
  }
  f.A_um = reach_both.width();
  f.A_up_um = reach_up.width();
  f.A_down_um = reach_down.width();
  f.E_um = mean_both.width();
  f.E_up_um = mean_up.width();
  f.E_down_um = mean_down.width();
  f.R_um = r_both.high();
  f.R_up_um = r_up.high();
  f.R_down_um = r_down.high();
  f.B_um = b.high();
  f.B_mean_um = b_sum / static_cast<double>(f.targets.size());
  f.M_um = mean_mean.width();
}

void vdi_3441(PositioningFigures& f) {
  Range means, reach, scatter, reversal;
  double scatter_sum = 0.0;
  double reversal_sum = 0.0;
  for (const auto& t : f.targets) {
    const double mean = 0.5 * (t.mean_up_um + t.mean_down_um);
    const double u = std::abs(t.reversal_um);
    const double ps = 6.0 * 0.5 * (t.s_up_um + t.s_down_um);
    means.add(mean);
    reach.add(mean + 0.5 * (u + ps));
    reach.add(mean - 0.5 * (u + ps));
    scatter.add(ps);
    reversal.add(u);
    scatter_sum += ps;
    reversal_sum += u;
  }
  const auto count = static_cast<double>(f.targets.size());
  f.P_um = reach.width();
  f.Pa_um = means.width();
  f.Ps_max_um = scatter.high();
  f.Ps_mean_um = scatter_sum / count;
  f.U_max_um = reversal.high();
  f.U_mean_um = reversal_sum / count;
}

}  // namespace

PositioningFigures positioning_figures(const LaserReport& report) {
  PositioningFigures figures{};
  figures.targets = targets_of(report);
  iso_230_2(figures);
  vdi_3441(figures);
  return figures;
}

nlohmann::json to_json(const PositioningFigures& f) {
  nlohmann::json targets = nlohmann::json::array();
  for (const auto& t : f.targets) {
    targets.push_back({{"target_mm", t.target_mm},
                       {"runs_up", t.runs_up},
                       {"runs_down", t.runs_down},
                       {"mean_up_um", t.mean_up_um},
                       {"mean_down_um", t.mean_down_um},
                       {"s_up_um", t.s_up_um},
                       {"s_down_um", t.s_down_um},
                       {"reversal_um", t.reversal_um}});
  }
  return {
      {"A_um", f.A_um},           {"A_up_um", f.A_up_um},     {"A_down_um", f.A_down_um}, {"E_um", f.E_um},
      {"E_up_um", f.E_up_um},     {"E_down_um", f.E_down_um}, {"R_um", f.R_um},           {"R_up_um", f.R_up_um},
      {"R_down_um", f.R_down_um}, {"B_um", f.B_um},           {"B_mean_um", f.B_mean_um}, {"M_um", f.M_um},
      {"P_um", f.P_um},           {"Pa_um", f.Pa_um},         {"Ps_max_um", f.Ps_max_um}, {"Ps_mean_um", f.Ps_mean_um},
      {"U_max_um", f.U_max_um},   {"U_mean_um", f.U_mean_um}, {"targets", targets}};
}

}  // namespace zerodrift::compensation
