#pragma once
// Step "physics" with the search (P2 to P5): beside the simulation of the warm-up run what it lacks, by core/diagnosis.

#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/diagnosis/diagnosis.h"

namespace zerodrift::flow {

/// The artefact "physics" of compare_physics, and what the search found in it:
///   "diagnosis": core/diagnosis' JSON, "adopted": [ids], "rejected": [ids],
///   "heat": {"component", "from_mm", "to_mm", "from_s", "to_s", "watts": [a position: [over time]]} | null,
///   "refined_machine": the machine description with what was found
/// and with "refined" beside the values of each curve. When the search fails "problems" holds {"said": "not_searched",
/// "code", "context"} and the rest is missing. Comes with the blob "refined.csv", the simulation with what was found. A
/// verification run serves as unseen data.
Result<commissioning::NewArtefact> find_missing(const commissioning::Job& job, const TaskContext& context);
/// The same artefact from a description that is not the profile's and what was found with it in the job's run.
Result<commissioning::NewArtefact> with_diagnosis(const commissioning::Job& job, const nlohmann::json& machine,
                                                  const diagnosis::Diagnosis& found, const TaskContext& context);

}  // namespace zerodrift::flow
