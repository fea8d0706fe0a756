#pragma once
// What the physics page asks for beside the step itself (core/flow/steps/diagnose_step): a person's judgement of an
// explanation, and a blind trial on a recording in which the virtual machine has hidden an effect.

#include <QString>
#include <memory>
#include <nlohmann/json_fwd.hpp>

#include "app/desktop/scratch_folder.h"
#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/recording/recording.h"

namespace zerodrift::desktop {

/// What a person thinks of the explanations: ids of effects.
struct Judgements {
  std::vector<std::string> adopted;
  std::vector<std::string> rejected;
};
Judgements judgements_of(const nlohmann::json& body);
/// The latest artefact "physics" with other judgements.
Result<commissioning::NewArtefact> judged(const commissioning::Job& job, const Judgements& judgements);

/// A blind trial in its order: the virtual machine hides an effect and seals its name, the run is watched, the search
/// answers, the seal is opened.
struct TrialCase {
  std::shared_ptr<ScratchFolder> folder;
  std::string seal;  // SHA-256 promised before the answer
  recording::Recording recorded;
  recording::Recording simulated;  // from the description, which lacks what is hidden
};
/// `program`: the virtual machine tool.
Result<TrialCase> make_trial(const QString& program, int seed, const TaskContext& context);

struct TrialAnswer {
  std::string effects;  // ids joined by "+", "none" or "unexplained"
  double confidence = 0.0;
  double improvement_percent = 0.0;  // of the rms over temperatures, on a second recording that was not fitted
  recording::Recording refined;
};
Result<TrialAnswer> answer_trial(const TrialCase& trial, const TaskContext& context);

struct OpenedSeal {
  std::string hidden;  // id, or "none"
  bool kept = false;   // the answer fits the promise
};
Result<OpenedSeal> open_trial(const TrialCase& trial);
/// A heat that is always there goes by two names.
bool same_effect(const std::string& hidden, const std::string& answer);

}  // namespace zerodrift::desktop
