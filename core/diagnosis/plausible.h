#pragma once
// Before any effect is looked for: could this recording be of this machine at all? Units that are off by a thousand or
// the wrong machine are no missing physics.

#include "core/base/result.h"
#include "core/diagnosis/model.h"

namespace zerodrift::diagnosis {

/// An error naming the channel whose movement differs from the simulated one by more than any missing effect could.
Status check_scale(const physics::Machine& machine, const Dataset& data, const physics::Prediction& nominal);

}  // namespace zerodrift::diagnosis
