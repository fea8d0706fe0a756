#pragma once
// The compensation table in the machine, over the control's link or by the hands of a person.

#include <functional>
#include <nlohmann/json_fwd.hpp>

#include "core/controller/table_log.h"
#include "core/controller/upload.h"
#include "core/flow/devices.h"

namespace zerodrift::commissioning {
class Job;
}

namespace zerodrift::flow {

/// Whether what an artefact "upload" (its body) wrote is active in the machine. table_not_active tells what is.
Status table_is_active(Devices& devices, const nlohmann::json& upload);

/// Writes the table, or only compares it (dry_run); the record tells how that ended. By hand it leaves as a file beside
/// the job.
controller::UploadRecord write_table(const commissioning::Job& job, Devices& devices, compensation::Table& table,
                                     controller::TableOrigin origin, const controller::UploadOptions& options,
                                     const TaskContext& context);

}  // namespace zerodrift::flow
