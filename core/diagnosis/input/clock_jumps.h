#pragma once
// A logger's clock that was set while it recorded leaves a gap in the times that the machine knows nothing of: taken
// for time it looks like something that happened once. Whether time passed, the machine itself says.

#include <vector>

#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

struct ClockJump {
  double at_s = 0.0;  // time of the first row after it, in the recording as it was given
  double by_s = 0.0;  // what the clock has too much from there on
};

/// Takes the jumps out of the recording's times: gaps of several sample intervals and at most half an hour after which
/// the machine goes on as if no time had passed, by the evidence of its simulation as described.
std::vector<ClockJump> take_out_clock_jumps(const physics::Machine& machine, recording::Recording& recording);

}  // namespace zerodrift::diagnosis
