#pragma once
// Where the errors of a run come from: camera and target (V1 to V4), displacement probes (V5).

#include <array>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/acquisition/stand.h"
#include "core/base/result.h"
#include "core/base/task_context.h"

namespace zerodrift::acquisition {

/// How one camera's pictures were waited for.
struct Settled {
  std::string view;
  double latency_s = 0.0;     // of the camera, mean
  double spread_s = 0.0;      // of the latency
  double standstill_s = 0.0;  // from the controller's word that the machine is at rest to the first picture that counts
  bool widened = false;       // its pictures were older than was known
};

/// Errors at the measuring position: error = actual - commanded, relative to the start of the run.
/// NaN in a direction that this source does not see or that was refused.
struct ErrorSample {
  std::array<double, 3> error_um;     // X Y Z
  std::array<double, 3> sigma_um;     // standard uncertainty of each
  std::vector<std::string> problems;  // why a direction is missing, one short reason each
  std::optional<Error> remark = {};   // what was seen and overcome: the numbers hold
  /// The host time the errors belong to, as the mean of the pictures' own; nothing: the middle of the call.
  std::optional<Seconds> seen = {};
  std::vector<Settled> settled = {};
  bool moved = false;  // the machine did not stay where it was to be measured
};

/// Nothing was measured, for these reasons.
inline ErrorSample not_measured(std::vector<std::string> problems, bool moved = false) {
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  ErrorSample sample{{nothing, nothing, nothing}, {nothing, nothing, nothing}, std::move(problems)};
  sample.moved = moved;
  return sample;
}

class ErrorSource {
 public:
  virtual ~ErrorSource() = default;
  /// Takes the zero: what is measured from now on is relative to this stand.
  virtual Status take_zero(const Stand& stand, const TaskContext& context) = 0;
  /// The zero in force, in um of the source's own scale, to be kept with the run: a run that goes on after a crash must
  /// go on from the same zero. Nothing when the source cannot say; then an interrupted run is not resumed.
  virtual std::optional<std::array<double, 3>> zero_um() const { return std::nullopt; }
  /// Puts a kept zero in force instead of taking one; false when the source cannot.
  virtual bool restore_zero_um(const std::array<double, 3>& /*zero_um*/) { return false; }
  /// One measurement of the machine at rest at the measuring position, tried again until the stand's `until` where the
  /// target does not stand still. What is refused is not a failure: its directions are NaN and problems says why. A
  /// failure is a dead source.
  virtual Result<ErrorSample> measure(const Stand& stand, const TaskContext& context) = 0;
  virtual std::string name() const = 0;
};

}  // namespace zerodrift::acquisition
