#pragma once
// Which short run would tell the best model from its rivals: from a library of forms, each from half an hour to three
// and a half, the shortest that is expected to decide, else the one that comes nearest to it. What counts is the
// difference of the predictions in noise widths that neither model's unknowns, as well as the recordings fix
// them, could absorb (T-optimality, Atkinson and Fedorov 1975).

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::answer {

/// Tells the best model and its rivals apart, each from each; said of the two that are told apart least.
SuggestedExperiment suggest_experiment(const inference::Fit& best, const std::vector<const inference::Fit*>& rivals);

}  // namespace zerodrift::diagnosis::answer
