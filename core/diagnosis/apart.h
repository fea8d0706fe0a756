#pragma once
// A machine of many lumps that nothing joins is as many small problems: each part is diagnosed on its own, with the
// room, the fluids and the inputs it shares with the others, and the answers are put together.

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

bool falls_apart(const physics::Machine& machine);
Result<Diagnosis> diagnose_apart(const physics::Machine& machine, const std::vector<recording::Recording>& recordings,
                                 const DiagnoseOptions& options, const TaskContext& context);

}  // namespace zerodrift::diagnosis
