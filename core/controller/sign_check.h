#pragma once
// The sign check: before a table is trusted, a small test offset is written and the camera or the probes watch it. A
// compensation of +d um moves the axis by +d, so the error seen grows by +d; a wrong sign, a wrong axis, nothing at all
// or a wrong size (outside 0.7 to 1.3 of it, beyond what the measurement may be wrong by) stops everything.

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/acquisition/error_source.h"
#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/controller/devices/manual_control.h"
#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {

struct SignCheckOptions {
  double offset_um = 10.0;  // below the machine's step limit
  std::vector<std::string> axes = {"X", "Y", "Z"};
};

struct SignCheckAxis {
  std::string axis;
  double commanded_um = 0.0;
  std::array<double, 3> seen_um{};   // change of the error in X, Y, Z; NaN where not seen
  std::array<double, 3> sigma_um{};  // standard uncertainty of each
  bool watched = false;              // false: the source does not see this direction
};

struct SignCheckRecord {
  std::vector<SignCheckAxis> axes;
  Status result;  // sign_check_failed with axis, commanded_um, seen_um; or what went wrong on the way
};

/// The machine stands at the measuring position and the source has its zero. The switch is left as it was found and the
/// offset at 0, whatever happens.
SignCheckRecord check_signs(ModbusMachine& machine, acquisition::ErrorSource& source, const SignCheckOptions& options,
                            const TaskContext& context);
/// The same with a person who enters the offsets.
SignCheckRecord check_signs(ManualControl& control, acquisition::ErrorSource& source, const SignCheckOptions& options,
                            const TaskContext& context);
nlohmann::json to_json(const SignCheckRecord& record);

}  // namespace zerodrift::controller
