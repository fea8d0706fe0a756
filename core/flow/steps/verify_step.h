#pragma once
// Step "verify" (C1, C2): a second run with the compensation on, measured against the zero of the warm-up run, so that
// what is measured is what is left. Proposes a correction of the coefficients when too much is left. Makes the artefact
// "verification":
//   {...as warm-up..., "peak_error_after_um": {"X", ...}, "rms_error_after_um" of the whole run,
//    "compared_s", "peak_error_before_um", "rms_error_before_um", "removed_percent", "end_error_before_um",
//    "end_error_after_um" over the same stretch, "reference": "same_run" (this run less what was applied) | "warmup"
//    (the same time since each run's start, as long as both went), "version_before": what the table before would have
//    left (verify_compare.h) | null,
//    "outside_range": [sensors beyond the model's range], "limit_um", "threshold_um", "verdict": "passed"|"failed",
//    "kappa": {...}, "correction": [...], "corrected_table": {...} | null, "machine_time_s": [from, to]}

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/compensation/residual.h"
#include "core/compensation/table.h"
#include "core/flow/devices.h"
#include "core/flow/steps/warmup_step.h"

namespace zerodrift::flow {

struct VerifyOptions {
  RunOptions run;             // an empty plan: verification_plan of the warm-up's
  double limit_um = 5.0;      // largest error that may be left, each direction
  double threshold_um = 2.0;  // a part error above this is worth a correction
};

/// The warm-up's speeds in another order with a rest between, three quarters as long.
acquisition::Plan verification_plan(const acquisition::Plan& warmup);

/// The verification that was broken off and can be gone on with: nothing when the last one was ended, or when a table
/// was written since it was begun. verify() goes on with it, and begins anew otherwise.
Result<std::optional<RecordedRun>> interrupted_verification(const commissioning::Job& job);

Result<commissioning::NewArtefact> verify(commissioning::Job& job, Devices& devices, const VerifyOptions& options,
                                          const TaskContext& context);

/// The latest verification judged by another threshold of part errors: the same run and figures, its own correction.
Result<commissioning::NewArtefact> judge_again(const commissioning::Job& job, double threshold_um);

/// What was left in the latest verification, by axis, with the temperatures of each measurement.
struct VerificationResiduals {
  compensation::Table table;  // that was compensating
  std::map<std::string, std::vector<compensation::ResidualSample>> samples;
  std::map<std::string, std::vector<double>> time_s;  // of the samples
};
Result<VerificationResiduals> verification_residuals(const commissioning::Job& job);

/// The corrected table an artefact "verification" proposes, if any.
Result<std::optional<compensation::Table>> corrected_table(const commissioning::Artefact& artefact);

}  // namespace zerodrift::flow
