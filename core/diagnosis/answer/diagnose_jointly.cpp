#include "core/diagnosis/answer/diagnose_jointly.h"

#include <chrono>

#include "core/diagnosis/answer/assess.h"
#include "core/diagnosis/bodies.h"
#include "core/diagnosis/checked_runs.h"

namespace zerodrift::diagnosis {

Result<Diagnosis> diagnose_jointly(const physics::Machine& machine, const std::vector<recording::Recording>& recordings,
                                   const DiagnoseOptions& options, const TaskContext& context,
                                   const DiagnosisSettings& settings) {
  if (recordings.empty())
    return fail(ErrorCode::bad_argument, {{"what", "recordings"}, {"found", "none"}, {"expected", "at least one"}});
  ZD_CHECK(settings.check());
  const auto began = std::chrono::steady_clock::now();
  ZD_TRY(const CheckedRuns runs, checked_runs(machine, recordings));
  const auto evidence =
      std::make_shared<const inference::Evidence>(with_inner_bodies(machine), runs.recordings, settings, context.stop);
  ZD_TRY(const search::Posterior posterior, search::stepwise_search(evidence, context));
  Diagnosis answer = answer::assess(posterior, machine, runs.recordings, options);
  answer.findings = runs.findings;
  answer.notes.insert(answer.notes.end(), runs.warnings.begin(), runs.warnings.end());
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  return answer;
}

}  // namespace zerodrift::diagnosis
