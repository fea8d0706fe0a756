#pragma once
// Writing to a machine leaves two entries in the job's audit trail: one before, one that tells how it ended.

#include <functional>

#include "core/acquisition/machine_io.h"
#include "core/commissioning/job.h"

namespace zerodrift::flow {

Status audited(commissioning::Job& job, commissioning::AuditEntry entry, const std::function<Status()>& work);

/// "VMC-850 #3 (serial 17)"
std::string machine_text(const std::string& name, std::uint32_t serial);

}  // namespace zerodrift::flow
