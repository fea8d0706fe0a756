#pragma once
// The way back of whatever wrote a host offset (host compensator, sign check): the offset runs to 0 at the machine's
// rate, is read back, and the switch goes back to where it was found. What cannot be done is told with what the machine
// holds.

#include <array>
#include <exception>
#include <functional>
#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {

struct OffsetExitOptions {
  double rate_um_s = 2.0;                             // of the machine's time
  double patience_s = 60.0;                           // host seconds without progress before it is given up
  double without_machine_s = 0.0;                     // host seconds of that already gone by
  double pause_s = 0.2;                               // host seconds between two steps
  bool switch_off = false;                            // it was found off and turned on since
  std::optional<std::array<double, 3>> last_um = {};  // what the controller held when it last answered
  std::function<Status()> may_write = {};             // an error while the controller must not be written to
  /// After each step: what the controller held before it, and how the step ended.
  std::function<void(const std::array<double, 3>& held_um, const Status& done)> observer = {};
};

/// compensation_left when the machine could not be left as it was found; `reason` is why the work ended.
Status leave_without_offset(ModbusMachine& machine, const OffsetExitOptions& options, const std::string& reason);

/// What is thrown between the first offset and the way back must not keep the offset in the machine.
template <class Work>
Status without_throwing(Work work) {
  try {
    return work();
  } catch (const std::exception& thrown) {
    return fail(ErrorCode::internal, {{"detail", thrown.what()}});
  }
}

/// "X 0.0, Y 0.0, Z -8.0 um"
std::string text_of_offset(const std::array<double, 3>& offset_um);
bool is_zero(const std::array<double, 3>& offset_um);

}  // namespace zerodrift::controller
