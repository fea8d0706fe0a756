#pragma once
// What was measured and is left out of the fit before it begins, so that the answer can say so: a gauge that never
// moves where the machine does, and single samples far from their neighbours.

#include <string>
#include <vector>

#include "core/analysis/findings.h"
#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

struct StillGauge {
  std::string channel;
  double always_um = 0.0;
  double simulated_um = 0.0;  // movement as described
};

/// Takes displacements out that repeat one value all the time where the machine as described moves far beyond what any
/// gauge resolves. None where heat of unknown size leaves nothing to compare with.
std::vector<StillGauge> take_out_still_gauges(const physics::Machine& machine, recording::Recording& recording);

/// For each channel that is compared with the simulation: how many samples no fit looks at, where there are a few. They
/// stay where they are.
std::vector<analysis::Finding> spikes_left_out(const physics::Machine& machine, const recording::Recording& recording);

}  // namespace zerodrift::diagnosis
