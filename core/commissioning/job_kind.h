#pragma once
// How a job comes to its data. Kept as an artefact "job" {"kind": ...}, so that who chose it and when is known; a job
// without one was made before there were kinds, and is one with a machine.

#include <string_view>

#include "core/base/result.h"
#include "core/commissioning/job.h"

namespace zerodrift::commissioning {

enum class JobKind {
  machine,  // a controller is connected, recorded from and written to
  manual,   // a control without any link: the engineer enters and confirms
  files,    // recordings and descriptions from files; nothing is connected, nothing is written
};
std::string_view name_of(JobKind kind);

/// job_damaged for a kind that this program does not know.
Result<JobKind> kind_of(const Job& job);
/// Nothing is put when the job is of this kind already.
Status set_kind(Job& job, JobKind kind);

}  // namespace zerodrift::commissioning
