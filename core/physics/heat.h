#pragma once
// The heat that comes into the machine's bodies from outside, by sources and by films; what goes from one body to the
// other is none of it.

#include <vector>

#include "core/physics/inputs.h"
#include "core/physics/network.h"

namespace zerodrift::physics {

/// W, of each interval between two samples, at node temperatures that are given: `field_C` [row * nodes + node], as
/// Trajectory has it. Heat that leaves is negative. One value fewer than the inputs have rows.
std::vector<double> heat_from_outside_W(const Network& network, const InputSet& inputs,
                                        const std::vector<double>& values, const std::vector<double>& field_C);

}  // namespace zerodrift::physics
