#pragma once
// The diagnosis by one inference: all recordings jointly, hypotheses ranked by one posterior. It stands beside
// diagnose() until it is at least as good in every world that both are judged by; then it takes its place.

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/inference/settings.h"

namespace zerodrift::diagnosis {

/// bad_argument without a recording or with settings that contradict each other; cancelled.
Result<Diagnosis> diagnose_jointly(const physics::Machine& machine, const std::vector<recording::Recording>& recordings,
                                   const DiagnoseOptions& options = {}, const TaskContext& context = {},
                                   const DiagnosisSettings& settings = {});

}  // namespace zerodrift::diagnosis
