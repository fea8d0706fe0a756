#pragma once
// Step "physics" (P1, S3): simulates the warm-up run from the machine description and compares it with the recording;
// recommends a sensor region. Makes the artefact "physics":
//   {"rmse": {"before": {...}}, "largest": {...}, "curves": [{channel, unit, time_h, values}], "placement": {...} |
//   null,
//    "notes": [...], "sentences": [...] in English, "said": [{id, facts}] the same for every language}
// with the blob "prediction.csv".

#include <nlohmann/json_fwd.hpp>

#include "core/base/task_context.h"
#include "core/commissioning/job.h"

namespace zerodrift::flow {

/// `machine`: a description from a file instead of the job's own (describe_step.h).
Result<commissioning::NewArtefact> compare_physics(const commissioning::Job& job, const TaskContext& context,
                                                   const nlohmann::json* machine = nullptr);

}  // namespace zerodrift::flow
