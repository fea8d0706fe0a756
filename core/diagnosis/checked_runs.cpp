#include "core/diagnosis/checked_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/analysis/checked.h"
#include "core/diagnosis/clock_jumps.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/left_out.h"
#include "core/diagnosis/long_gaps.h"
#include "core/diagnosis/units.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {
namespace {

void tell_findings(CheckedRuns& runs) {
  const std::vector<RunFinding>& findings = runs.findings;
  std::set<std::string> units_told;
  for (const auto& [recording, finding] : findings) {
    const std::string kind(analysis::name_of(finding.kind));
    const bool unit =
        finding.kind == analysis::FindingKind::fahrenheit || finding.kind == analysis::FindingKind::kelvin;
    const auto alike = std::count_if(findings.begin(), findings.end(),
                                     [&recording = recording, &finding = finding](const RunFinding& other) {
                                       return other.recording == recording && other.finding.kind == finding.kind;
                                     });
    if (!unit || alike == 1) {
      runs.told.push_back(
          explain_note("run_finding", {{"recording", recording}, {"what", analysis::describe(finding)}}));
    } else if (units_told.insert(recording + kind).second) {
      runs.told.push_back(explain_note("run_" + kind, {{"recording", recording}}));
    }
  }
}

/// The first input that `one` logs and uses and `other` has no column for.
std::string column_lacking(const recording::Recording& other, const recording::Recording& one) {
  for (const auto& channel : one.channels) {
    if (!recording::is_input(channel.kind()) || other.find(channel.name) != nullptr) continue;
    if (std::any_of(channel.values.begin(), channel.values.end(), [](double v) { return std::abs(v) > 0.0; })) {
      return channel.name;
    }
  }
  return {};
}

/// What is not logged is simulated as if it were off: a recording without such a column bears nothing out.
void leave_out_what_lacks_inputs(CheckedRuns& runs) {
  for (std::size_t i = runs.recordings.size(); i-- > 1;) {
    const recording::Recording& first = runs.recordings.front();
    const recording::Recording& other = runs.recordings[i];
    const std::string lacking = column_lacking(other, first);
    const std::string fitted_lacks = column_lacking(first, other);
    if (!fitted_lacks.empty()) {
      runs.told.push_back(explain_note("run_lacks_what_other_has",
                                       {{"recording", first.name}, {"column", fitted_lacks}, {"other", other.name}}));
    }
    if (lacking.empty()) continue;
    runs.told.push_back(
        explain_note("run_lacks_column", {{"recording", other.name}, {"column", lacking}, {"other", first.name}}));
    runs.recordings.erase(runs.recordings.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Columns that drive nothing of the machine: a measurement's own uncertainty, a counter, a remark.
void leave_out_what_drives_nothing(const physics::Machine& machine, recording::Recording& recording) {
  const physics::Network network = physics::build_network(machine, recording);
  std::set<std::string> used(network.held_channels.begin(), network.held_channels.end());
  used.insert(network.linear_channels.begin(), network.linear_channels.end());
  std::erase_if(recording.channels, [&](const recording::Channel& channel) {
    return channel.kind() == recording::ChannelKind::input && used.count(channel.name) == 0;
  });
}

/// A speed or a switch that was not logged is taken as it was before.
void tell_input_gaps(const recording::Recording& one, CheckedRuns& runs) {
  constexpr double worth_telling_percent = 2.0;
  for (const auto& channel : one.channels) {
    if (!recording::is_input(channel.kind())) continue;
    const auto none =
        std::count_if(channel.values.begin(), channel.values.end(), [](double v) { return !std::isfinite(v); });
    const double percent =
        100.0 * static_cast<double>(none) / static_cast<double>(std::max<std::size_t>(1, one.rows()));
    if (percent < worth_telling_percent) continue;
    runs.warnings.push_back(fmt::format("input_gaps:{}:{}", one.name, channel.name));
    runs.told.push_back(
        explain_note("run_input_gaps",
                     {{"recording", one.name}, {"column", channel.name}, {"percent", fmt::format("{:.0f}", percent)}}));
  }
}

void leave_out_still_gauges(const physics::Machine& machine, recording::Recording& recording,
                            const std::vector<recording::Recording>& all, CheckedRuns& runs,
                            std::vector<RunFinding>& told) {
  for (const StillGauge& gauge : take_out_still_gauges(machine, recording, all)) {
    const std::string value = fmt::format("{:.4g}", gauge.always_um);
    const bool used = gauge.why == StillGauge::Why::at_rest;
    const analysis::Finding finding{analysis::FindingKind::error_never_moves,
                                    used ? analysis::FindingAction::noted : analysis::FindingAction::dropped,
                                    gauge.channel, "always " + value};
    if (!used) runs.warnings.push_back(fmt::format("never_changes:{}:{}", recording.name, gauge.channel));
    if (gauge.why != StillGauge::Why::moves_as_described) {
      runs.findings.push_back({recording.name, finding});
      continue;
    }
    runs.told.push_back(explain_note("run_gauge_never_changes", {{"recording", recording.name},
                                                                 {"channel", gauge.channel},
                                                                 {"value", value},
                                                                 {"um", fmt::format("{:.0f}", gauge.simulated_um)}}));
    told.push_back({recording.name, finding});
  }
}

/// What was measured and the description knows nothing of: often a name spelt otherwise.
std::string unknown_columns(const physics::Machine& machine, const std::set<std::string>& boundaries,
                            const recording::Recording& one) {
  using recording::ChannelKind;
  std::string list;
  for (const auto& channel : one.channels) {
    const ChannelKind kind = channel.kind();
    if (kind != ChannelKind::temperature && kind != ChannelKind::error) continue;
    const bool displacement = std::any_of(machine.displacements.begin(), machine.displacements.end(),
                                          [&](const auto& known) { return known.channel == channel.name; });
    if (displacement || machine.sensor(channel.name) != nullptr || boundaries.count(channel.name) != 0) continue;
    list += (list.empty() ? "" : ", ") + channel.name;
  }
  return list;
}

}  // namespace

Result<CheckedRuns> checked_runs(const physics::Machine& machine, const std::vector<recording::Recording>& given) {
  CheckedRuns out;
  ZD_CHECK(analysis::check_distinct(given));
  const std::set<std::string> boundaries = physics::measured_boundaries(machine);
  std::vector<RunFinding> still;  // told already
  for (const auto& one : given) {
    analysis::Checked sound = analysis::checked(one, boundaries);
    for (const auto& finding : sound.findings) {
      const bool needed = boundaries.count(finding.channel) != 0 && finding.channel != machine.room.channel;
      if (needed && finding.action == analysis::FindingAction::dropped) {
        return fail(ErrorCode::data_does_not_fit, {{"what", one.name + ", channel " + finding.channel},
                                                   {"found", analysis::describe(finding)},
                                                   {"expected", "a temperature that the simulation can follow"}});
      }
      out.findings.push_back({one.name, finding});
    }
    if (auto part = longest_part(sound.recording)) {
      out.warnings.push_back(part->note);
      out.told.push_back(explain_note("run_left_out", {{"what", std::move(part->note)}}));
      sound.recording = std::move(part->recording);
    }
    ZD_TRY(auto more, physics::check_recording(machine, sound.recording));
    bool one_is_missing = false;
    for (auto& warning : more) {
      const bool taken_out = std::any_of(sound.findings.begin(), sound.findings.end(), [&](const auto& finding) {
        return finding.action == analysis::FindingAction::dropped && warning.ends_with(" " + finding.channel);
      });
      if (taken_out) continue;
      one_is_missing = true;
      out.warnings.push_back(std::move(warning));
    }
    for (const auto& displacement : machine.displacements) {
      if (one.find(displacement.channel) != nullptr) continue;
      one_is_missing = true;
      out.warnings.push_back(one.name + " has no channel " + displacement.channel);
    }
    // A machine has more sensors than its description as a rule: only beside one that is missed they tell anything.
    if (const std::string unknown = unknown_columns(machine, boundaries, sound.recording);
        one_is_missing && !unknown.empty()) {
      out.told.push_back(explain_note("run_unknown_columns", {{"recording", one.name}, {"columns", unknown}}));
    }
    ZD_CHECK(check_units(machine, sound.recording));
    leave_out_what_drives_nothing(machine, sound.recording);
    tell_input_gaps(sound.recording, out);
    if (const auto unit = load_in_other_unit(machine, sound.recording)) {
      out.warnings.push_back(fmt::format("load_in_other_unit:{}:{}", one.name, unit->symbol));
      out.told.push_back(
          explain_note("load_in_other_unit",
                       {{"recording", one.name}, {"most", fmt::format("{:.3g}", unit->most)}, {"unit", unit->symbol}}));
    }
    for (const ClockJump& jump : take_out_clock_jumps(machine, sound.recording)) {
      out.warnings.push_back(fmt::format("clock_jumped:{}:{:.0f}:{:.0f}", one.name, jump.at_s, jump.by_s));
      out.told.push_back(explain_note("clock_jumped", {{"recording", one.name},
                                                       {"by", fmt::format("{:.3g}", jump.by_s / 60.0)},
                                                       {"at", fmt::format("{:.0f}", jump.at_s / 60.0)}}));
    }
    leave_out_still_gauges(machine, sound.recording, given, out, still);
    for (auto& spikes : spikes_left_out(machine, sound.recording))
      out.findings.push_back({one.name, std::move(spikes)});
    out.recordings.push_back(std::move(sound.recording));
  }
  tell_findings(out);
  out.findings.insert(out.findings.end(), still.begin(), still.end());
  leave_out_what_lacks_inputs(out);
  return out;
}

}  // namespace zerodrift::diagnosis
