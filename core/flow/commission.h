#pragma once
// The whole job without a person: machine, calibrate, warm-up, sensors, fit, physics, upload, verify; a correction and
// a second verification when a part error of the first exceeds its threshold, another where the second fails. Each is
// done by Flow::perform, and what the job already holds and is current is not done again: a commissioning that was
// broken off goes on where it stopped, and sensors chosen by hand stay chosen. A step that is out of date is done again
// as it was asked for.

#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "core/acquisition/plan.h"
#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/controller/operator.h"
#include "core/controller/profile.h"
#include "core/flow/machine_write.h"

namespace zerodrift::flow {

struct CommissionOptions {
  acquisition::Plan plan;
  access::Permit permit = access::Permit::read_only();  // it writes: without one nothing is begun
  Consent consent;                                      // asked before each write that stays in the machine
  std::shared_ptr<controller::Operator> person;         // of a manual control
  double limit_um = 5.0;
  bool keep_views = true;  // the pictures of the calibration's positions
};

struct CommissionResult {
  nlohmann::json verification;  // body of the artefact
  nlohmann::json upload;
  nlohmann::json sensors;
};

/// Whether the correction that a verification proposes is worth another verification run. What is left after a
/// correction is one slow wave of model error: corrected by it once more, the next run finds the opposite. It is worth
/// it only where the corrected table failed. Bodies of the artefacts.
bool correction_due(const nlohmann::json& verification, const nlohmann::json& upload);

/// `profile_document` is what `profile` was read from; it is kept in the job. access_locked or not_confirmed before
/// anything moves when the table could not be written in the end.
Result<CommissionResult> commission(commissioning::Job& job, const controller::Profile& profile,
                                    const nlohmann::json& profile_document, const CommissionOptions& options,
                                    const TaskContext& context);

}  // namespace zerodrift::flow
