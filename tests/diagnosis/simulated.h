#pragma once
// Every refined machine that a test gets is written, read back and simulated on the recording it was fitted to: the
// command `simulate` on the file of `diagnose --refined` must give what was reported, but for what is new in each
// recording (offsets of sensors, start temperatures, which part of a sample interval a speed was set in).

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/diagnosis/diagnosis.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {

/// Starts or inputs that no description holds make another simulation.
inline bool has_a_start_of_its_own(const Diagnosis& d) {
  return std::any_of(d.notes.begin(), d.notes.end(), [](const Note& note) {
    return note.code == NoteCode::warm_start || note.code == NoteCode::clock_late ||
           note.code == NoteCode::clock_early || note.code == NoteCode::room_not_logged;
  });
}

inline void expect_simulated_as_reported(const Diagnosis& d, const recording::Recording& run) {
  constexpr double times_noise = 2.0;
  constexpr double of_the_range = 0.03;
  constexpr double of_the_reported = 0.2;  // where much is left unexplained: adds a fiftieth of it, in squares
  const auto refined = physics::machine_from_json(physics::to_json(d.refined), "refined.json");
  ASSERT_TRUE(refined.has_value()) << describe(refined.error());
  // What the diagnosis left out of the recording, the command refuses to simulate beside.
  recording::Recording used = run;
  std::erase_if(used.channels, [&](const recording::Channel& channel) {
    return d.refined.sensor(channel.name) != nullptr &&
           physics::measured_boundaries(d.refined).count(channel.name) == 0 &&
           channel.kind() == recording::ChannelKind::temperature &&
           std::none_of(d.channels.begin(), d.channels.end(),
                        [&](const ChannelReport& one) { return one.channel == channel.name; });
  });
  const auto simulation = physics::simulate(*refined, used);
  ASSERT_TRUE(simulation.has_value()) << describe(simulation.error());
  if (has_a_start_of_its_own(d)) return;
  std::map<double, std::size_t> row_at;
  for (std::size_t k = 0; k < run.rows(); ++k) row_at[run.time_s[k]] = k;
  for (const ChannelReport& channel : d.channels) {
    const recording::Channel* simulated = simulation->prediction.find(channel.channel);
    if (simulated == nullptr || channel.explained.size() != d.time_s.size()) continue;
    double sum = 0.0, squares = 0.0, count = 0.0;
    for (std::size_t k = 0; k < d.time_s.size(); ++k) {
      const auto row = row_at.find(d.time_s[k]);
      if (row == row_at.end()) continue;
      const double apart = simulated->values[row->second] - channel.explained[k];
      sum += apart;
      squares += apart * apart;
      count += 1.0;
    }
    if (count < 2.0) continue;
    const auto [low, high] = std::minmax_element(channel.explained.begin(), channel.explained.end());
    const double rms = std::sqrt(std::max(0.0, squares / count - std::pow(sum / count, 2)));
    EXPECT_LE(rms, std::max({times_noise * channel.noise, of_the_range * (*high - *low),
                             of_the_reported * channel.rms_explained}))
        << channel.channel << " of " << run.name << ", reported " << channel.rms_explained;
  }
}

/// As diagnose(), with that expectation.
inline Result<Diagnosis> diagnosed_and_simulated(const physics::Machine& machine,
                                                 const std::vector<recording::Recording>& recordings,
                                                 const DiagnoseOptions& options = {}, const TaskContext& context = {}) {
  auto result = diagnose(machine, recordings, options, context);
  if (result) expect_simulated_as_reported(*result, recordings.front());
  return result;
}

}  // namespace zerodrift::diagnosis
