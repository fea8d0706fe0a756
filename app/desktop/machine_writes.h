#pragma once
// What is written to a machine beside the steps: going back to the table before, a check of the signs, the switch. Each
// is put into the job's audit trail before and after. Work for the task thread; the question is asked before.

#include <functional>

#include "core/commissioning/job.h"
#include "core/controller/sign_check.h"
#include "core/controller/upload.h"
#include "core/flow/devices.h"

namespace zerodrift::desktop {

/// Back to the table before the newest; makes the artefact "upload" of what is active then.
Result<commissioning::NewArtefact> roll_back(commissioning::Job& job, const controller::Profile& profile,
                                             access::Permit permit,
                                             const std::function<void(const controller::UploadStep&)>& observer,
                                             const TaskContext& context);

/// Small test offsets, watched by the camera or the probes. A check that failed is a record too, with the failure in
/// it.
Result<controller::SignCheckRecord> try_signs(commissioning::Job& job, const controller::Profile& profile,
                                              access::Permit permit, const TaskContext& context);

/// The state the switch has afterwards.
Result<bool> switch_compensation(commissioning::Job* job, const controller::Profile& profile, access::Permit permit,
                                 bool on);

}  // namespace zerodrift::desktop
