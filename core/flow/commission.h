#pragma once
// The whole job without a person: machine, calibrate, warm-up, sensors, fit, physics, upload, verify; a correction and
// a second verification when a part error of the first exceeds its threshold. What the job already holds and is current
// is not done again, so a commissioning that was broken off goes on where it stopped.

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "core/acquisition/plan.h"
#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/controller/profile.h"
#include "core/flow/steps/upload_step.h"

namespace zerodrift::flow {

struct CommissionOptions {
  acquisition::Plan plan;
  access::Permit permit = access::Permit::read_only();  // it writes: without one the first write is refused
  double limit_um = 5.0;
  bool keep_views = true;                                // the pictures of the calibration's positions
  std::function<bool(const UploadPreview&)> confirm;     // absent: confirmed
  std::function<void(const std::string&)> step_started;  // "machine", "calibrate", ...
};

struct CommissionResult {
  nlohmann::json verification;  // body of the artefact
  nlohmann::json upload;
  nlohmann::json sensors;
};

/// `profile_document` is what `profile` was read from; it is kept in the job.
Result<CommissionResult> commission(commissioning::Job& job, const controller::Profile& profile,
                                    const nlohmann::json& profile_document, const CommissionOptions& options,
                                    const TaskContext& context);

}  // namespace zerodrift::flow
