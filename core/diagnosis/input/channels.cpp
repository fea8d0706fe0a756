#include "core/diagnosis/input/channels.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/input/samples.h"
#include "core/physics/builder.h"
#include "core/physics/initial_state.h"
#include "core/physics/inputs.h"
#include "core/physics/prediction.h"

namespace zerodrift::diagnosis {
namespace {

using recording::Recording;

bool is_driven(const physics::Machine& machine, const Recording& recording) {
  const physics::Network network = physics::build_network(machine, recording);
  return !physics::nothing_drives(physics::make_inputs(network, recording)) || physics::starts_warm(machine, recording);
}

/// Some channel moves by far more than its noise.
bool moves(const physics::Machine& machine, const Recording& recording) {
  constexpr double sigmas = 12.0;
  for (const ChannelSamples& channel : samples_of(recording, physics::build_network(machine, recording))) {
    double low = 1e300, high = -1e300;
    for (std::size_t k = 0; k < channel.values.size(); ++k) {
      if (channel.present[k]) low = std::min(low, channel.values[k]), high = std::max(high, channel.values[k]);
    }
    if (high - low > sigmas * channel.noise) return true;
  }
  return false;
}

double seconds_between_rows(const Recording& recording) {
  return (recording.time_s.back() - recording.time_s.front()) / static_cast<double>(recording.rows() - 1);
}

/// Two sensors fit whatever heats between them and around them.
void few_sensors(const physics::Machine& machine, const std::vector<Recording>& recordings, std::vector<Note>& notes) {
  constexpr std::ptrdiff_t few = 2;
  for (const auto& component : machine.components) {
    if (component.lump) continue;
    const auto used = std::count_if(machine.sensors.begin(), machine.sensors.end(), [&](const auto& sensor) {
      return sensor.component == component.id &&
             std::any_of(recordings.begin(), recordings.end(),
                         [&](const Recording& one) { return one.find(sensor.channel) != nullptr; });
    });
    if (used > few) continue;
    notes.push_back({NoteCode::few_sensors, {{"component", component.id}, {"count", std::to_string(used)}}});
  }
}

/// What switches between two rows that are far apart has moved the machine by an unknown amount.
void coarse_rows(const physics::Machine& machine, const std::vector<Recording>& recordings, std::vector<Note>& notes) {
  constexpr double coarse_s = 120.0;
  double least_s = 1e300;
  for (const Recording& one : recordings) {
    if (is_driven(machine, one)) least_s = std::min(least_s, seconds_between_rows(one));
  }
  if (least_s < coarse_s || least_s > 1e299) return;
  notes.push_back({NoteCode::coarse_rows, {{"seconds", fmt::format("{:.0f}", least_s)}}});
}

}  // namespace

bool is_excited(const physics::Machine& machine, const std::vector<Recording>& recordings) {
  return std::any_of(recordings.begin(), recordings.end(),
                     [&](const Recording& one) { return is_driven(machine, one) && moves(machine, one); });
}

std::vector<std::string> columns_lacking(const physics::Machine& machine, const std::vector<Recording>& recordings) {
  std::vector<std::string> missing;
  const auto look_for = [&](const std::string& channel) {
    if (std::none_of(recordings.begin(), recordings.end(),
                     [&](const Recording& one) { return one.find(channel) != nullptr; }))
      missing.push_back(channel);
  };
  for (const auto& sensor : machine.sensors) {
    if (sensor.component != "ambient") look_for(sensor.channel);
  }
  for (const auto& displacement : machine.displacements) look_for(displacement.channel);
  return missing;
}

std::vector<Note> limits_of(const physics::Machine& machine, const std::vector<Recording>& recordings) {
  std::vector<Note> notes;
  if (!is_excited(machine, recordings)) notes.push_back({NoteCode::no_excitation, {}});
  few_sensors(machine, recordings, notes);
  coarse_rows(machine, recordings, notes);
  return notes;
}

}  // namespace zerodrift::diagnosis
