#include "core/diagnosis/input/checked_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/analysis/checked.h"
#include "core/diagnosis/input/clock_jumps.h"
#include "core/diagnosis/input/left_out.h"
#include "core/diagnosis/input/long_gaps.h"
#include "core/diagnosis/input/units.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {
namespace {

/// A recording that is too short shows nothing of a machine.
Status check_length(const recording::Recording& recording) {
  constexpr double shortest_s = 60.0;  // nothing of a machine warms up in less
  constexpr std::size_t fewest_rows = 10;
  const auto too_little = [&](const std::string& found, const std::string& needed) {
    return fail(ErrorCode::not_enough_data, {{"what", recording.name}, {"found", found}, {"needed", needed}});
  };
  const double whole_s = recording.time_s.back() - recording.time_s.front();
  if (whole_s < shortest_s) return too_little(fmt::format("{:g} s", whole_s), fmt::format("{:g} s", shortest_s));
  if (recording.rows() < fewest_rows)
    return too_little(fmt::format("{} samples", recording.rows()), std::to_string(fewest_rows));
  return {};
}

/// Samples of all channels that the description and the recordings share.
Status check_shared(const physics::Machine& machine, const std::vector<recording::Recording>& recordings) {
  constexpr std::size_t fewest = 20;
  std::size_t samples = 0;
  const auto add = [&](const std::string& channel) {
    for (const auto& one : recordings) {
      if (const auto* found = one.find(channel)) samples += recording::present_count(*found);
    }
  };
  for (const auto& sensor : machine.sensors) {
    if (sensor.component != "ambient") add(sensor.channel);
  }
  for (const auto& displacement : machine.displacements) add(displacement.channel);
  if (samples >= fewest) return {};
  return fail(ErrorCode::not_enough_data,
              {{"what", "the channels that " + machine.file + " and " + recordings.front().name + " share"},
               {"found", fmt::format("{} samples", samples)},
               {"needed", std::to_string(fewest)}});
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
      runs.notes.push_back({NoteCode::lacks_what_other_has,
                            {{"recording", first.name}, {"column", fitted_lacks}, {"other", other.name}}});
    }
    if (lacking.empty()) continue;
    runs.notes.push_back(
        {NoteCode::lacks_column, {{"recording", other.name}, {"column", lacking}, {"other", first.name}}});
    runs.recordings.erase(runs.recordings.begin() + static_cast<std::ptrdiff_t>(i));
  }
}

/// Could a column that the description does not use drive the machine? A fan, a door, a pump come and go; a counter, a
/// measurement's own uncertainty and a remark do not.
bool could_drive(const recording::Channel& channel) {
  constexpr double mostly = 0.5;  // of the rows have a value
  constexpr double step = 0.1;    // of its range, between neighbouring rows
  constexpr double seldom = 0.1;  // of the rows
  double low = 1e300, high = -1e300;
  for (const double value : channel.values) {
    if (std::isfinite(value)) low = std::min(low, value), high = std::max(high, value);
  }
  std::size_t present = 0, steps = 0, rises = 0, falls = 0;
  double before = std::nan("");
  for (const double value : channel.values) {
    if (!std::isfinite(value)) continue;
    ++present;
    rises += value > before ? 1 : 0;
    falls += value < before ? 1 : 0;
    steps += std::abs(value - before) > step * (high - low) ? 1 : 0;
    before = value;
  }
  const auto often = static_cast<std::size_t>(seldom * static_cast<double>(channel.values.size()));
  const bool counter = (rises == 0 || falls == 0) && rises + falls > often;
  return static_cast<double>(present) > mostly * static_cast<double>(channel.values.size()) && high > low && !counter &&
         steps <= often;
}

/// Columns that neither drive the machine nor could.
void leave_out_what_drives_nothing(const physics::Machine& machine, recording::Recording& recording) {
  const physics::Network network = physics::build_network(machine, recording);
  std::set<std::string> used(network.held_channels.begin(), network.held_channels.end());
  used.insert(network.linear_channels.begin(), network.linear_channels.end());
  std::erase_if(recording.channels, [&](const recording::Channel& channel) {
    return channel.kind() == recording::ChannelKind::input && used.count(channel.name) == 0 && !could_drive(channel);
  });
}

/// A speed or a switch that was not logged is taken as it was before.
void report_input_gaps(const recording::Recording& one, CheckedRuns& runs) {
  constexpr double worth_telling_percent = 2.0;
  for (const auto& channel : one.channels) {
    if (!recording::is_input(channel.kind())) continue;
    const auto none =
        std::count_if(channel.values.begin(), channel.values.end(), [](double v) { return !std::isfinite(v); });
    const double percent =
        100.0 * static_cast<double>(none) / static_cast<double>(std::max<std::size_t>(1, one.rows()));
    if (percent < worth_telling_percent) continue;
    runs.notes.push_back(
        {NoteCode::input_gaps,
         {{"recording", one.name}, {"column", channel.name}, {"percent", fmt::format("{:.0f}", percent)}}});
  }
}

void leave_out_still_gauges(const physics::Machine& machine, recording::Recording& recording,
                            const std::vector<recording::Recording>& all, CheckedRuns& runs) {
  for (const StillGauge& gauge : take_out_still_gauges(machine, recording, all)) {
    const std::string value = fmt::format("{:.4g}", gauge.always_um);
    const bool used = gauge.why == StillGauge::Why::at_rest;
    runs.findings.push_back(
        {recording.name,
         {analysis::FindingKind::error_never_moves,
          used ? analysis::FindingAction::noted : analysis::FindingAction::dropped, gauge.channel, "always " + value}});
    if (used) continue;
    Note note{NoteCode::never_changes, {{"recording", recording.name}, {"channel", gauge.channel}, {"value", value}}};
    if (gauge.why == StillGauge::Why::moves_as_described) note.facts["um"] = fmt::format("{:.0f}", gauge.simulated_um);
    runs.notes.push_back(std::move(note));
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

/// Sensors and displacements that the recording as given lacks.
bool report_missing_channels(const physics::Machine& machine, const recording::Recording& given, CheckedRuns& runs) {
  bool any = false;
  const auto look_for = [&](const std::string& channel) {
    if (given.find(channel) != nullptr) return;
    any = true;
    runs.notes.push_back({NoteCode::missing_channel, {{"recording", given.name}, {"channel", channel}}});
  };
  for (const auto& sensor : machine.sensors) look_for(sensor.channel);
  for (const auto& displacement : machine.displacements) look_for(displacement.channel);
  return any;
}

}  // namespace

Result<CheckedRuns> checked_runs(const physics::Machine& machine, const std::vector<recording::Recording>& given) {
  CheckedRuns out;
  ZD_CHECK(analysis::check_distinct(given));
  const std::set<std::string> boundaries = physics::measured_boundaries(machine);
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
      out.notes.push_back({NoteCode::left_out, {{"recording", one.name}, {"what", std::move(part->note)}}});
      sound.recording = std::move(part->recording);
    }
    ZD_CHECK(physics::check_recording(machine, sound.recording).map([](const auto&) {}));
    ZD_CHECK(check_length(sound.recording));
    const bool one_is_missing = report_missing_channels(machine, one, out);
    // A machine has more sensors than its description as a rule: only beside one that is missed they tell anything.
    if (const std::string unknown = unknown_columns(machine, boundaries, sound.recording);
        one_is_missing && !unknown.empty()) {
      out.notes.push_back({NoteCode::unknown_columns, {{"recording", one.name}, {"columns", unknown}}});
    }
    ZD_CHECK(check_units(machine, sound.recording));
    leave_out_what_drives_nothing(machine, sound.recording);
    report_input_gaps(sound.recording, out);
    if (const auto unit = load_in_other_unit(machine, sound.recording)) {
      out.notes.push_back(
          {NoteCode::load_in_other_unit,
           {{"recording", one.name}, {"most", fmt::format("{:.3g}", unit->most)}, {"unit", unit->symbol}}});
    }
    for (const ClockJump& jump : take_out_clock_jumps(machine, sound.recording)) {
      out.notes.push_back({NoteCode::clock_jumped,
                           {{"recording", one.name},
                            {"by", fmt::format("{:.3g}", jump.by_s / 60.0)},
                            {"at", fmt::format("{:.0f}", jump.at_s / 60.0)}}});
    }
    leave_out_still_gauges(machine, sound.recording, given, out);
    ZD_CHECK(check_scale(machine, sound.recording));
    for (auto& spikes : spikes_left_out(machine, sound.recording))
      out.findings.push_back({one.name, std::move(spikes)});
    out.recordings.push_back(std::move(sound.recording));
  }
  leave_out_what_lacks_inputs(out);
  ZD_CHECK(check_shared(machine, out.recordings));
  return out;
}

}  // namespace zerodrift::diagnosis
