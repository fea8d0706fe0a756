#pragma once
// The machine's processors, shared by whole fits where there are several and by the columns of one fit where there is
// one.

#include <cstddef>
#include <functional>
#include <vector>

#include "core/physics/prediction.h"

namespace zerodrift::diagnosis {

/// Runs the jobs on as many threads as the machine has (at most four).
void in_parallel(std::size_t count, const std::function<void(std::size_t)>& job);

/// As physics::predict, to the last digit; many columns go to several threads, unless other jobs keep those busy.
physics::Prediction predicted(const physics::Network& network, const physics::InputSet& inputs,
                              const std::vector<double>& values, const std::vector<int>& parameters);

}  // namespace zerodrift::diagnosis
