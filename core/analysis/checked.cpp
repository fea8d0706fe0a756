#include "core/analysis/checked.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analysis/cleaning.h"

namespace zerodrift::analysis {
namespace {

using recording::Channel;
using recording::ChannelKind;
using recording::Recording;

bool is_temperature(const Channel& channel) {
  return channel.kind() == ChannelKind::temperature || channel.kind() == ChannelKind::ambient;
}

/// Without the outermost 2 %: a spike is no movement.
double movement(const std::vector<double>& values) {
  std::vector<double> sorted;
  for (const double v : values) {
    if (std::isfinite(v)) sorted.push_back(v);
  }
  if (sorted.size() < 4) return 0.0;
  std::sort(sorted.begin(), sorted.end());
  return sorted[sorted.size() - 1 - sorted.size() / 50] - sorted[sorted.size() / 50];
}

/// Of the temperatures of one recording, K, ascending.
std::vector<double> rises(const Recording& recording) {
  std::vector<double> list;
  for (const Channel& channel : recording.channels) {
    if (is_temperature(channel)) list.push_back(movement(channel.values));
  }
  std::sort(list.begin(), list.end());
  return list;
}

/// Whether a channel with this fault tells what is not so; the rest of its samples may be right.
bool lies(const Finding& fault, const Channel& channel, const std::set<std::string>& may_stand_still,
          const std::vector<double>& time_s, const std::vector<double>& values) {
  const bool room = channel.kind() == ChannelKind::ambient;
  const bool held = !room && may_stand_still.count(channel.name) != 0;  // by a thermostat
  if (fault.kind == FindingKind::constant_sensor) return !room && !held;
  if (fault.kind == FindingKind::sensor_died) return !held && frozen_stretch(time_s, values).has_value();
  if (fault.kind == FindingKind::dead_sensor) return recording::present_count(channel) < 3;
  return true;
}

}  // namespace

std::vector<std::optional<Finding>> check_temperatures(const std::vector<std::string>& channels,
                                                       const std::vector<double>& time_s,
                                                       std::vector<std::vector<double>>& values,
                                                       std::vector<Finding>& findings) {
  for (auto& series : values) {
    for (double& v : series) {
      if (!std::isfinite(v)) v = missing_sample;
    }
  }
  convert_units(channels, values, findings);
  std::vector<std::optional<Finding>> faults;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    const int spikes = remove_spikes(values[c]);
    faults.push_back(fatal_fault(channels[c], time_s, values[c]));
    if (spikes == 0 || faults.back()) continue;
    findings.push_back({FindingKind::spikes, FindingAction::repaired, channels[c], fmt::format("{} samples", spikes)});
  }
  return faults;
}

Checked checked(const Recording& recording, const std::set<std::string>& may_stand_still) {
  constexpr double much_K = 2.0;  // of the others: a machine that rests is measured rightly by constants
  Checked out{recording, {}};
  std::vector<std::string> names;
  std::vector<std::vector<double>> converted;
  for (const Channel& channel : recording.channels) {
    if (!is_temperature(channel)) continue;
    names.push_back(channel.name);
    converted.push_back(channel.values);
  }
  convert_units(names, converted, out.findings);
  for (std::size_t c = 0; c < names.size(); ++c) out.recording.find(names[c])->values = converted[c];
  const std::vector<double> moved = rises(out.recording);
  const bool at_rest = moved.empty() || moved.back() < much_K;
  std::vector<Finding> told;  // units are converted already, and spikes are left to whoever looks at the samples
  const auto faults = check_temperatures(names, recording.time_s, converted, told);
  const auto out_of_reach = std::count_if(
      faults.begin(), faults.end(), [](const auto& fault) { return fault && fault->kind == FindingKind::implausible; });
  const bool wrong_unit = 2 * out_of_reach > std::ssize(names);  // not some sensors: the comparison refuses them
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (faults[c] && wrong_unit && faults[c]->kind == FindingKind::implausible) continue;
    if (!faults[c] || (at_rest && faults[c]->kind == FindingKind::constant_sensor)) continue;
    if (!lies(*faults[c], *out.recording.find(names[c]), may_stand_still, recording.time_s, converted[c])) continue;
    out.findings.push_back(*faults[c]);
    std::erase_if(out.recording.channels, [&](const Channel& channel) { return channel.name == names[c]; });
  }
  return out;
}

Status check_distinct(const std::vector<Recording>& recordings) {
  const auto same = [](const std::vector<double>& a, const std::vector<double>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                      [](double x, double y) { return x == y || (!std::isfinite(x) && !std::isfinite(y)); });
  };
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      int measured = 0, equal = 0;
      for (const Channel& channel : recordings[i].channels) {
        if (recording::is_input(channel.kind())) continue;
        const Channel* twin = recordings[j].find(channel.name);
        ++measured;
        if (twin != nullptr && same(channel.values, twin->values)) ++equal;
      }
      if (measured == 0 || equal < measured) continue;
      return fail(ErrorCode::bad_argument, {{"what", "the recording " + recordings[i].name},
                                            {"found", "the same run as " + recordings[j].name},
                                            {"expected", "another run, or each run once"}});
    }
  }
  return {};
}

Status check_error_unit(const Recording& recording) {
  // Nobody compensates what half a micrometre holds, and 40 m of steel move by 500 um/K.
  constexpr double warm_K = 5.0;
  constexpr double least_um = 0.5;
  constexpr double most_um_per_K = 500.0;
  const std::vector<double> warmed = rises(recording);
  double largest_um = 0.0;
  std::string names;
  for (const Channel& channel : recording.channels) {
    if (channel.kind() != ChannelKind::error || recording::present_count(channel) < 4) continue;
    largest_um = std::max(largest_um, movement(channel.values));
    names += (names.empty() ? "" : ", ") + channel.name;
  }
  if (warmed.empty() || warmed.back() < warm_K || largest_um <= 0.0) return {};
  const bool small = largest_um < least_um;
  if (!small && largest_um < most_um_per_K * warmed.back()) return {};
  return fail(ErrorCode::data_does_not_fit,
              {{"what", recording.name + ", " + names},
               {"found", fmt::format("a movement of {:.2g} um beside {:.2g} K", largest_um, warmed.back())},
               {"expected", small ? "errors in um (are they in mm?)" : "errors in um (are they in nm?)"}});
}

std::optional<Finding> doubtful_times(const Recording& recording) {
  constexpr double fast_K_per_s = 0.05;  // of the warmest sensor over a whole run
  if (recording.rows() < 4) return std::nullopt;
  const std::vector<double> warmed = rises(recording);
  const double whole_s = recording.time_s.back() - recording.time_s.front();
  if (warmed.empty() || !(warmed.back() > fast_K_per_s * whole_s)) return std::nullopt;
  return Finding{FindingKind::doubtful_times, FindingAction::noted, "time_s",
                 fmt::format("{:.0f} K in {:.0f} s", warmed.back(), whole_s)};
}

}  // namespace zerodrift::analysis
