#pragma once
// What is written to a machine beside the step "upload": going back to a former table, a check of the signs, the
// switch. Each goes by MachineWrite.

#include <functional>

#include "core/commissioning/job.h"
#include "core/controller/rollback.h"
#include "core/controller/sign_check.h"
#include "core/flow/devices.h"
#include "core/flow/machine_write.h"
#include "core/flow/steps/upload_step.h"

namespace zerodrift::flow {

/// What going back would change; writes nothing to the machine.
struct RollbackPreview {
  controller::RollbackTarget target;
  UploadPreview difference;
};
/// To the entry `id` of the machine's log. What only the job knows of the machine's tables is taken into the log first.
Result<RollbackPreview> preview_roll_back(const commissioning::Job& job, const controller::Profile& profile,
                                          const std::string& id, const TaskContext& context);

/// Writes the table that was looked at; makes the artefact "upload" of what is active then.
Result<commissioning::NewArtefact> roll_back(commissioning::Job& job, const controller::Profile& profile,
                                             access::Permit permit, const Consent& consent,
                                             const controller::RollbackTarget& target,
                                             const std::function<void(const controller::UploadStep&)>& observer,
                                             const TaskContext& context);

/// Small test offsets, watched by the camera or the probes. A check that failed is a record too, with the failure in
/// it.
Result<controller::SignCheckRecord> try_signs(commissioning::Job& job, const controller::Profile& profile,
                                              access::Permit permit, const Consent& consent,
                                              const TaskContext& context);

/// Nothing is written when the switch is there already. Without a job the history of the machine's tables keeps it. The
/// state the switch has afterwards.
Result<bool> switch_compensation(commissioning::Job* job, Devices& devices, const Consent& consent, bool on);

}  // namespace zerodrift::flow
