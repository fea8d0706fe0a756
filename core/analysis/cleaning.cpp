#include "core/analysis/cleaning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/recording/unit_suspicion.h"

namespace zerodrift::analysis {
namespace {

double median_of(std::vector<double> values) {
  if (values.empty()) return missing_sample;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

std::vector<double> present(const std::vector<double>& values) {
  std::vector<double> out;
  for (const double v : values) {
    if (std::isfinite(v)) out.push_back(v);
  }
  return out;
}

struct Stretch {
  std::size_t first = 0;
  std::size_t last = 0;  // one past its last sample
  int samples = 0;
};

/// The longest stretch, by time, in which no sample differs from the one before.
Stretch longest_still(const std::vector<double>& time_s, const std::vector<double>& values) {
  Stretch longest;
  Stretch now;
  double longest_s = 0.0;
  double last = missing_sample;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    if (values[i] != last) now = {i, i, 0};
    last = values[i];
    now.last = i + 1;
    ++now.samples;
    if (time_s[i] - time_s[now.first] <= longest_s) continue;
    longest_s = time_s[i] - time_s[now.first];
    longest = now;
  }
  return longest;
}

/// True when, outside these rows, more than half of the steps change the value and some of them go back: a noisy
/// sensor, so that standing still is odd. What only creeps from one step of a coarse reading to the next is not.
bool is_noisy(const std::vector<double>& values, const Stretch& outside) {
  int moves = 0;
  int turns = 0;
  int steps = 0;
  double last = missing_sample;
  double direction = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i == outside.first) last = missing_sample;
    if (!std::isfinite(values[i]) || (i >= outside.first && i < outside.last)) continue;
    if (std::isfinite(last)) {
      ++steps;
      if (values[i] != last) {
        ++moves;
        if ((values[i] - last) * direction < 0.0) ++turns;
        direction = values[i] - last;
      }
    }
    last = values[i];
  }
  return steps >= 20 && 2 * moves > steps && 10 * turns > moves;
}

}  // namespace

int remove_spikes(std::vector<double>& values) {
  for (double& v : values) {
    if (!std::isfinite(v)) v = missing_sample;
  }
  constexpr int reach = 5;
  constexpr double smallest_spike_K = 0.8;
  const std::vector<double> original = values;
  const int n = static_cast<int>(values.size());
  int removed = 0;
  for (int i = 0; i < n; ++i) {
    if (!std::isfinite(original[i])) continue;
    std::vector<double> around;
    for (int j = std::max(0, i - reach); j <= std::min(n - 1, i + reach); ++j) {
      if (j != i && std::isfinite(original[j])) around.push_back(original[j]);
    }
    if (around.size() < 4) continue;
    const double middle = median_of(around);
    std::vector<double> deviation;
    for (const double v : around) deviation.push_back(std::abs(v - middle));
    const double sigma = 1.4826 * median_of(std::move(deviation));
    if (std::abs(original[i] - middle) > std::max(6.0 * sigma, smallest_spike_K)) {
      values[i] = missing_sample;
      ++removed;
    }
  }
  return removed;
}

int remove_wild_errors(std::vector<double>& values) {
  constexpr double share_of_range = 0.2;
  constexpr double scatters = 10.0;
  constexpr std::size_t fewest = 12;
  std::vector<std::size_t> rows;
  std::vector<double> v;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) continue;
    rows.push_back(i);
    v.push_back(values[i]);
  }
  if (v.size() < fewest) return 0;
  std::vector<double> sorted = v;
  std::sort(sorted.begin(), sorted.end());
  const std::size_t edge = std::max<std::size_t>(v.size() / 50, 1);
  const double range = sorted[v.size() - 1 - edge] - sorted[edge];
  std::vector<double> bends;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) bends.push_back(std::abs(v[i - 1] - 2.0 * v[i] + v[i + 1]));
  const double scatter = 1.4826 * median_of(std::move(bends)) / std::sqrt(6.0);
  const double allowed = std::max(share_of_range * range, scatters * scatter);
  int removed = 0;
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {  // the first and last may well be the largest: a start is steep
    double above = std::numeric_limits<double>::infinity();
    double below = above;
    for (std::size_t k = i < 2 ? 0 : i - 2; k <= std::min(i + 2, v.size() - 1); ++k) {
      if (k == i) continue;
      above = std::min(above, v[i] - v[k]);
      below = std::min(below, v[k] - v[i]);
    }
    if (std::max(above, below) <= allowed || allowed <= 0.0) continue;
    values[rows[i]] = missing_sample;
    ++removed;
  }
  return removed;
}

std::vector<Dropout> remove_dropouts(std::vector<double>& values) {
  constexpr int fewest = 4;
  constexpr int many = 20;
  constexpr double steps = 6.0;        // of those that it makes otherwise, but for the largest twentieth
  constexpr double steps_still = 3.0;  // where it is noisy otherwise
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i])) rows.push_back(i);
  }
  const auto at = [&](std::size_t k) { return values[rows[k]]; };
  std::vector<double> moves;
  for (std::size_t k = 1; k < rows.size(); ++k) {
    if (at(k) != at(k - 1)) moves.push_back(std::abs(at(k) - at(k - 1)));
  }
  if (moves.size() < fewest) return {};
  std::sort(moves.begin(), moves.end());
  const double usual = moves[moves.size() - 1 - moves.size() / 20];
  std::vector<Dropout> found;
  for (std::size_t k = 1; k < rows.size();) {
    std::size_t end = k + 1;
    while (end < rows.size() && at(end) == at(k)) ++end;
    const double out = at(k) - at(k - 1);
    const double back = end < rows.size() ? at(end) - at(k) : 0.0;
    const std::size_t samples = end - k;
    const std::size_t after = end < rows.size() ? rows[end] : values.size();
    const double jump = out * back < 0.0 ? std::min(std::abs(out), std::abs(back)) : 0.0;
    const bool left = jump > steps * usual;
    const bool still = samples >= many && jump > steps_still * usual && is_noisy(values, {rows[k], after, 0});
    if (samples >= fewest && 2 * samples < rows.size() && (left || still)) found.push_back({rows[k], after, at(k)});
    k = end;
  }
  for (const Dropout& one : found) {
    std::fill(values.begin() + static_cast<std::ptrdiff_t>(one.first),
              values.begin() + static_cast<std::ptrdiff_t>(one.last), missing_sample);
  }
  return found;
}

std::vector<Finding> told(const std::vector<Dropout>& dropouts, const std::string& channel,
                          const std::vector<double>& time_s) {
  std::vector<Finding> findings;
  for (const Dropout& one : dropouts) {
    findings.push_back(
        {FindingKind::dropout, FindingAction::repaired, channel,
         fmt::format("reads {:.4g} from {:.0f} to {:.0f} s", one.value, time_s[one.first], time_s[one.last - 1])});
  }
  return findings;
}

std::optional<Finding> fatal_fault(const std::string& channel, const std::vector<double>& time_s,
                                   const std::vector<double>& values) {
  const std::vector<double> there = present(values);
  if (there.size() < 3 || there.size() * 20 < values.size()) {
    return Finding{FindingKind::dead_sensor, FindingAction::dropped, channel, fmt::format("{} samples", there.size())};
  }
  const auto [low, high] = std::minmax_element(there.begin(), there.end());
  if (*high - *low < 1e-9) {
    return Finding{FindingKind::constant_sensor, FindingAction::dropped, channel, fmt::format("always {:.4g}", *low)};
  }
  if (*low < -60.0 || *high > 1200.0) {
    return Finding{FindingKind::implausible, FindingAction::dropped, channel,
                   fmt::format("{:.4g} to {:.4g}", *low, *high)};
  }
  const double duration_s = time_s.back() - time_s.front();
  std::size_t last = values.size();
  while (last > 0 && !std::isfinite(values[last - 1])) --last;
  if (time_s.back() - time_s[last - 1] > 0.1 * duration_s) {
    return Finding{FindingKind::sensor_died, FindingAction::dropped, channel,
                   fmt::format("no samples from {:.0f} s", time_s[last - 1])};
  }
  if (const auto frozen = frozen_stretch(time_s, values)) {
    const bool for_good = std::none_of(values.begin() + static_cast<std::ptrdiff_t>(frozen->second), values.end(),
                                       [](double v) { return std::isfinite(v); });
    return Finding{
        FindingKind::sensor_died, FindingAction::dropped, channel,
        for_good ? fmt::format("frozen from {:.0f} s", time_s[frozen->first])
                 : fmt::format("frozen from {:.0f} to {:.0f} s", time_s[frozen->first], time_s[frozen->second - 1])};
  }
  return std::nullopt;
}

std::optional<std::pair<std::size_t, std::size_t>> frozen_stretch(const std::vector<double>& time_s,
                                                                  const std::vector<double>& values) {
  constexpr int fewest = 50;
  if (time_s.empty()) return std::nullopt;
  const Stretch still = longest_still(time_s, values);
  if (still.samples < fewest) return std::nullopt;
  const double still_s = time_s[still.last - 1] - time_s[still.first];
  if (still_s <= 0.1 * (time_s.back() - time_s.front()) || !is_noisy(values, still)) return std::nullopt;
  return std::pair{still.first, still.last};
}

double bridge_gaps(const std::vector<double>& time_s, std::vector<double>& values) {
  double longest_s = 0.0;
  const std::size_t n = values.size();
  std::size_t before = n;
  for (std::size_t i = 0; i < n; ++i) {
    if (!std::isfinite(values[i])) continue;
    if (before == n) {
      for (std::size_t j = 0; j < i; ++j) values[j] = values[i];
      if (i > 0) longest_s = time_s[i] - time_s[0];
    } else if (i > before + 1) {
      longest_s = std::max(longest_s, time_s[i] - time_s[before]);
      for (std::size_t j = before + 1; j < i; ++j) {
        const double f = (time_s[j] - time_s[before]) / (time_s[i] - time_s[before]);
        values[j] = values[before] + f * (values[i] - values[before]);
      }
    }
    before = i;
  }
  if (before == n) return 0.0;
  for (std::size_t j = before + 1; j < n; ++j) values[j] = values[before];
  if (before + 1 < n) longest_s = std::max(longest_s, time_s[n - 1] - time_s[before]);
  return longest_s;
}

void hold_gaps(std::vector<double>& values) {
  double last = 0.0;
  for (const double v : values) {
    if (std::isfinite(v)) {
      last = v;
      break;
    }
  }
  for (double& v : values) {
    if (std::isfinite(v)) {
      last = v;
    } else {
      v = last;
    }
  }
}

void suspect_units(const std::vector<std::string>& channels, const std::vector<std::vector<double>>& values,
                   std::vector<Finding>& findings) {
  for (const auto& one : recording::suspected_units(values)) {
    findings.push_back({one.kelvin ? FindingKind::kelvin : FindingKind::fahrenheit, FindingAction::noted,
                        channels[one.channel], fmt::format("starts at {:.4g}", one.start_C)});
  }
}

}  // namespace zerodrift::analysis
