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
  enum class Why {
    moves_as_described,  // far beyond what any gauge resolves
    reads_elsewhere,     // in another recording it shows noise: alive it cannot repeat itself
    at_rest              // perhaps: nothing moves it by more than it may resolve
  };
  std::string channel;
  double always_um = 0.0;
  double simulated_um = 0.0;  // movement as described, 0 where heat of unknown size leaves nothing to compare with
  Why why = Why::at_rest;
};

/// The displacements that repeat one value all the time. What cannot be a gauge at rest is taken out.
std::vector<StillGauge> take_out_still_gauges(const physics::Machine& machine, recording::Recording& recording,
                                              const std::vector<recording::Recording>& all);

/// For each channel that is compared with the simulation: how many samples no fit looks at, where there are a few. They
/// stay where they are.
std::vector<analysis::Finding> spikes_left_out(const physics::Machine& machine, const recording::Recording& recording);

}  // namespace zerodrift::diagnosis
