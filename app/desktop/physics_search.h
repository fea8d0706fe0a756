#pragma once
// What the physics page asks for, as work for the task thread: simulate the run, find what the simulation lacks; and a
// blind trial on a recording in which the virtual machine has hidden an effect.

#include <QString>

#include "core/commissioning/job.h"
#include "core/diagnosis/diagnosis.h"

namespace zerodrift::desktop {

/// The artefact "physics" of the step, and what the search found in it:
///   "diagnosis": core/diagnosis' JSON, "adopted": [ids], "rejected": [ids],
///   "heat": {"component", "from_mm", "to_mm", "from_s", "to_s", "watts": [[over time] a position]} | null,
///   "refined_machine": the machine description with what was found
/// with the blob "refined.csv", the simulation with what was found. A verification run serves as unseen data.
Result<commissioning::NewArtefact> find_missing(const commissioning::Job& job, const TaskContext& context);

/// The same artefact after a person has judged an explanation.
Result<commissioning::NewArtefact> judged(const commissioning::Job& job, const std::string& effect, bool adopted,
                                          bool rejected);

struct Trial {
  std::string hidden;                // id of the effect, opened after the answer
  std::string answer;                // id of the effect found, "nothing", "unexplained"
  double improvement_percent = 0.0;  // of the rms over temperatures, on the second recording
  bool sealed = false;               // the answer fits the commitment that was made before
};

/// `program`: the virtual machine tool.
Result<Trial> blind_trial(const QString& program, int seed, const TaskContext& context);

}  // namespace zerodrift::desktop
