#pragma once
// Where the errors of a run come from: camera and target (V1 to V4), displacement probes (V5).

#include <array>
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task_context.h"

namespace zerodrift::acquisition {

/// Errors at the measuring position: error = actual - commanded, relative to the start of the run.
/// NaN in a direction that this source does not see or that was refused.
struct ErrorSample {
  std::array<double, 3> error_um;     // X Y Z
  std::array<double, 3> sigma_um;     // standard uncertainty of each
  std::vector<std::string> problems;  // why a direction is missing, one short reason each
  std::optional<Error> remark = {};   // what was seen and overcome: the numbers hold
  /// The moment the errors belong to, as the mean of the pictures' own; nothing: the middle of the call.
  std::optional<std::chrono::steady_clock::time_point> seen = {};
};

class ErrorSource {
 public:
  virtual ~ErrorSource() = default;
  /// Takes the zero: what is measured from now on is relative to this moment.
  virtual Status take_zero(const TaskContext& context) = 0;
  /// The zero in force, in um of the source's own scale, to be kept with the run: a run that goes on after a crash must
  /// go on from the same zero. Nothing when the source cannot say; then an interrupted run is not resumed.
  virtual std::optional<std::array<double, 3>> zero_um() const { return std::nullopt; }
  /// Puts a kept zero in force instead of taking one; false when the source cannot.
  virtual bool restore_zero_um(const std::array<double, 3>& /*zero_um*/) { return false; }
  /// One measurement with the machine standing at the measuring position. A refused frame is not a failure:
  /// its directions are NaN and problems says why. A failure is a dead source.
  virtual Result<ErrorSample> measure(const TaskContext& context) = 0;
  virtual std::string name() const = 0;
};

}  // namespace zerodrift::acquisition
