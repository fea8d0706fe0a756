#pragma once
// What a recording can excite, so that effects can say in which forms they could be missing.

#include "core/physics/effects/effect.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis::search {

physics::RunFacts run_facts(const physics::Machine& machine, const recording::Recording& recording);
/// Of all recordings together: what any of them excites.
physics::RunFacts merged(const std::vector<physics::RunFacts>& facts);

}  // namespace zerodrift::diagnosis::search
