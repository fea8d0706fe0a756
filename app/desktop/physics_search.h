#pragma once
// What the physics page asks for beside the step itself (core/flow/steps/diagnose_step): a person's judgement of an
// explanation, and a blind trial on a recording in which the virtual machine has hidden an effect.

#include <QString>

#include "core/commissioning/job.h"
#include "core/diagnosis/diagnosis.h"

namespace zerodrift::desktop {

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
