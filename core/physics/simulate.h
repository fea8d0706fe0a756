#pragma once
// The simulation a user sees: a machine description and a recording's inputs give a recording with the same channels,
// as far as the model can predict them; and how far it is from what was measured.

#include <string>
#include <vector>

#include "core/base/task_context.h"
#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::physics {

struct Simulation {
  recording::Recording prediction;         // time_s, the inputs, and every channel the model predicts
  std::vector<std::string> predicted;      // names of the predicted channels
  std::vector<std::string> not_predicted;  // measured channels that the description does not name
  std::vector<std::string> notes;          // what was assumed: "room_is_initial_temperature", "capacity_unknown:L1" ...
};

Result<Simulation> simulate(const Machine& machine, const recording::Recording& inputs,
                            const TaskContext& context = {});

/// The recording with the simulated displacements beside it, as inputs of a regression: "simulated_dZ" for dZ_um, in
/// um, counted from the recording's first row.
Result<recording::Recording> with_simulation(const Machine& machine, const recording::Recording& recording,
                                             const TaskContext& context = {});

struct ChannelDifference {
  std::string channel;
  bool temperature = true;
  double rms = 0.0;  // K or um
  double largest = 0.0;
  double largest_at_s = 0.0;
};

/// Measured against predicted, channel by channel (channels of both).
std::vector<ChannelDifference> compare(const recording::Recording& prediction, const recording::Recording& measured);

/// Channels and units make sense together: the machine's sensors are in the recording, temperatures are Celsius,
/// lengths of the right order. One sentence's worth of facts as an Error, or what is worth a warning.
Result<std::vector<std::string>> check_recording(const Machine& machine, const recording::Recording& recording);

}  // namespace zerodrift::physics
