#pragma once
// What a verification is measured against. The same stretch without the compensation: what was applied is recorded with
// every measurement, and measured = error + applied, so each run carries its own reference - same speeds, same minutes,
// same room. A run in which nothing applied was recorded (an older job, an imported one) is held against the warm-up
// run over the same minutes since the starts, and says so. And the same stretch with the version before: what another
// table would have left of the same error at the same temperatures.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/commissioning/job.h"
#include "core/compensation/residual.h"
#include "core/compensation/table.h"
#include "core/recording/recording.h"
#include "core/report/comparison.h"

namespace zerodrift::flow {

struct VerificationReference {
  recording::Recording without;  // errors as they would be without compensation
  bool same_run = false;         // false: the warm-up run
};
VerificationReference reference_of(const recording::Recording& verification, const recording::Recording& warmup);

using ResidualSamples = std::map<std::string, std::vector<compensation::ResidualSample>>;

struct AxisAgainstBefore {
  std::string axis;
  double rms_before_um = 0.0;  // what the version before would have left
  double rms_now_um = 0.0;
  double peak_before_um = 0.0;
  double peak_now_um = 0.0;
  bool worse = false;  // now, by more than a measurement is uncertain
};
/// Axes that both tables have; `samples` were measured with `now`.
std::vector<AxisAgainstBefore> against_before(const ResidualSamples& samples, const compensation::Table& now,
                                              const compensation::Table& before);

/// {"version", "uploads": [of now, before], "contradicted": an earlier verification found the table before worse than
/// the one of now, "axes": [{axis, rms_before_um, rms_now_um, peak_before_um, peak_now_um, worse}]} for the table that
/// this job wrote before the upload `upload`; null when there is none.
nlohmann::json version_before(const commissioning::Job& job, commissioning::ArtefactId upload,
                              const ResidualSamples& samples, const compensation::Table& now);

/// The sensors that went furthest beyond the range the model was made in, at most three, each where it was furthest, as
/// "T3_C 43.10 C (valid 18.00 to 41.00)": there the table guesses.
std::vector<std::string> furthest_outside(const recording::Recording& run, const compensation::Table& table);

}  // namespace zerodrift::flow
