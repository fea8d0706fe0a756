#pragma once
// The recordings as a diagnosis uses them: checked (core/analysis/checked.h), without what a long gap hides, and
// comparable with the machine's description. What cannot be compared is an error that says what to look at.

#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

struct CheckedRuns {
  std::vector<recording::Recording> recordings;
  std::vector<RunFinding> findings;
  std::vector<Note> notes;  // what of them is not used and why
};

Result<CheckedRuns> checked_runs(const physics::Machine& machine, const std::vector<recording::Recording>& given);
}  // namespace zerodrift::diagnosis
