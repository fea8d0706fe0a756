#pragma once
// Are a recording's columns in the units that the description expects? Nothing is named from one that is off.

#include <optional>

#include "core/base/result.h"
#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

/// An error naming the channel whose movement differs from the simulated one by more than any missing effect could.
Status check_scale(const physics::Machine& machine, const recording::Recording& recording);

/// An error where the times only make sense in minutes, hours or milliseconds, or the speeds in 1000 rpm or percent:
/// the machine as described is nothing like the recording, but is like it with other ones; or where the room's column
/// and a sensor's are exchanged.
Status check_units(const physics::Machine& machine, const recording::Recording& recording);

struct LoadUnit {
  const char* symbol;  // "kW", "%", or "kW / %" where it may be either
  double most = 0.0;   // as logged
};
/// The unit in which the load would be one of this machine's motor, and hardly any in W; the fit goes on.
std::optional<LoadUnit> load_in_other_unit(const physics::Machine& machine, const recording::Recording& recording);

}  // namespace zerodrift::diagnosis
