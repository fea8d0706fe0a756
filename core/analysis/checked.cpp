#include "core/analysis/checked.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

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
  if (fault.kind == FindingKind::constant_sensor) {
    // A room may be held to a hundredth of a kelvin, but zero in every row is what a logger writes for no sensor.
    const bool nothing = std::all_of(values.begin(), values.end(), [](double v) { return !(std::abs(v) > 0.0); });
    return room ? nothing : !held;
  }
  if (fault.kind == FindingKind::sensor_died) return !held && frozen_stretch(time_s, values).has_value();
  if (fault.kind == FindingKind::dead_sensor) return recording::present_count(channel) < 3;
  return true;
}

void take_out_dropouts(const std::string& channel, const std::vector<double>& time_s, std::vector<double>& values,
                       std::vector<Finding>& findings) {
  const std::vector<Finding> list = told(remove_dropouts(values), channel, time_s);
  findings.insert(findings.end(), list.begin(), list.end());
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
  suspect_units(channels, values, findings);
  std::vector<std::optional<Finding>> faults;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    take_out_dropouts(channels[c], time_s, values[c], findings);
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
  std::vector<std::vector<double>> temperatures;
  for (const Channel& channel : recording.channels) {
    if (!is_temperature(channel)) continue;
    names.push_back(channel.name);
    temperatures.push_back(channel.values);
  }
  suspect_units(names, temperatures, out.findings);
  for (Channel& channel : out.recording.channels) {
    const bool measured = is_temperature(channel) || channel.kind() == ChannelKind::error;
    const bool held = channel.kind() == ChannelKind::temperature && may_stand_still.count(channel.name) != 0;
    if (!measured || held) continue;
    take_out_dropouts(channel.name, recording.time_s, channel.values, out.findings);
  }
  const std::vector<double> moved = rises(out.recording);
  const bool at_rest = moved.empty() || moved.back() < much_K;
  // Units and dropouts are named already, and spikes are left to whoever looks at the samples.
  std::vector<Finding> again;
  const auto faults = check_temperatures(names, recording.time_s, temperatures, again);
  const auto out_of_reach = std::count_if(
      faults.begin(), faults.end(), [](const auto& fault) { return fault && fault->kind == FindingKind::implausible; });
  const bool wrong_unit = 2 * out_of_reach > std::ssize(names);  // not some sensors: the comparison refuses them
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (faults[c] && wrong_unit && faults[c]->kind == FindingKind::implausible) continue;
    if (!faults[c] || (at_rest && faults[c]->kind == FindingKind::constant_sensor)) continue;
    if (!lies(*faults[c], *out.recording.find(names[c]), may_stand_still, recording.time_s, temperatures[c])) continue;
    out.findings.push_back(*faults[c]);
    std::erase_if(out.recording.channels, [&](const Channel& channel) { return channel.name == names[c]; });
  }
  return out;
}

namespace {

constexpr double absent = -1e300;  // compares, other than what is not a number

std::vector<std::string> measured_in_both(const Recording& a, const Recording& b) {
  std::vector<std::string> names;
  for (const Channel& channel : a.channels) {
    if (!recording::is_input(channel.kind()) && b.find(channel.name) != nullptr) names.push_back(channel.name);
  }
  return names;
}

std::vector<std::vector<double>> rows_of(const Recording& one, const std::vector<std::string>& names) {
  std::vector<std::vector<double>> rows(one.rows());
  for (const std::string& name : names) {
    const std::vector<double>& values = one.find(name)->values;
    for (std::size_t k = 0; k < rows.size(); ++k) rows[k].push_back(std::isfinite(values[k]) ? values[k] : absent);
  }
  return rows;
}

/// The longest stretch that both recordings have number for number, rows.
std::size_t longest_common_stretch(const Recording& a, const Recording& b) {
  const std::vector<std::string> names = measured_in_both(a, b);
  if (names.empty()) return 0;
  const auto rows_a = rows_of(a, names);
  const auto rows_b = rows_of(b, names);
  std::map<std::vector<double>, std::vector<std::size_t>> where;
  for (std::size_t k = 0; k < rows_a.size(); ++k) where[rows_a[k]].push_back(k);
  std::size_t longest = 0;
  std::map<std::size_t, std::size_t> ending;  // at row of a: length of the stretch that ends there and at b's last row
  for (const auto& row : rows_b) {
    std::map<std::size_t, std::size_t> next;
    if (const auto same = where.find(row); same != where.end()) {
      for (const std::size_t k : same->second) {
        const auto before = k == 0 ? ending.end() : ending.find(k - 1);
        longest = std::max(longest, next[k] = 1 + (before == ending.end() ? 0 : before->second));
      }
    }
    ending = std::move(next);
  }
  return longest;
}

/// Nothing in them moves: rows are alike because the machine stood still.
bool stands_still(const Recording& one) {
  return std::all_of(one.channels.begin(), one.channels.end(), [](const Channel& channel) {
    return recording::is_input(channel.kind()) || movement(channel.values) == 0.0;
  });
}

}  // namespace

Status check_distinct(const std::vector<Recording>& recordings) {
  for (std::size_t i = 0; i < recordings.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::size_t shorter = std::min(recordings[i].rows(), recordings[j].rows());
      const std::size_t common = longest_common_stretch(recordings[i], recordings[j]);
      const bool all = common == recordings[i].rows() && common == recordings[j].rows();
      if (common == 0 || 2 * common < shorter || (!all && stands_still(recordings[i]))) continue;
      return fail(ErrorCode::bad_argument,
                  {{"what", "the recording " + recordings[i].name},
                   {"found", all ? "the same run as " + recordings[j].name
                                 : fmt::format("{} of its rows number for number in {}", common, recordings[j].name)},
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
                 fmt::format("{:.3g} K in {:.0f} s", warmed.back(), whole_s)};
}

}  // namespace zerodrift::analysis
