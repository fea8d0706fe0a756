#pragma once
// What is written to a machine beside the steps: going back to a former table, a check of the signs, the switch. Each
// is put into the job's audit trail before and after. Work for the task thread; the question is asked before.

#include <functional>

#include "core/commissioning/job.h"
#include "core/controller/rollback.h"
#include "core/controller/sign_check.h"
#include "core/flow/devices.h"
#include "core/flow/steps/upload_step.h"

namespace zerodrift::desktop {

/// What going back to the entry `id` of the machine's log would change; writes nothing to the machine. What only the
/// job knows of the machine's tables is taken into the log first.
struct RollbackPreview {
  controller::RollbackTarget target;
  flow::UploadPreview difference;
};
Result<RollbackPreview> preview_roll_back(const commissioning::Job& job, const controller::Profile& profile,
                                          const std::string& id, const TaskContext& context);

/// Writes the table that was looked at; makes the artefact "upload" of what is active then.
Result<commissioning::NewArtefact> roll_back(commissioning::Job& job, const controller::Profile& profile,
                                             access::Permit permit, const controller::RollbackTarget& target,
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
