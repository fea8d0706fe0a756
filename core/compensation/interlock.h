#pragma once
// The interlock (R4): measuring for a model and compensating exclude each other.
//   switch on  = compensated state:     measuring model data is forbidden, and so is staging a table
//   switch off = non-compensated state: writing compensation values to the machine is forbidden
// Each function answers for one operation; the operation's name goes into the error.

#include <string>

#include "core/base/result.h"

namespace zerodrift::compensation {

/// interlock_compensation_on when the switch is on: the recorded error would be the remainder, not the error.
Status allow_model_measurement(bool compensation_on);
/// interlock_compensation_on when the switch is on: a table is never changed while the machine uses it.
Status allow_staging(bool compensation_on);
/// interlock_compensation_off when the switch is off: no offset moves an axis of an uncompensated machine.
Status allow_offset_write(bool compensation_on);

}  // namespace zerodrift::compensation
