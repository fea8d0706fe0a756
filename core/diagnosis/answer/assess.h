#pragma once
// From the posterior to the answer: which effects carry how much of its mass, what each channel is left with, where and
// when heat is missing, and the description that says so.

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/input/checked_runs.h"
#include "core/diagnosis/search/stepwise_search.h"

namespace zerodrift::diagnosis::answer {

/// `runs`: whole, in the order of the posterior's runs.
Diagnosis assess(const search::Posterior& posterior, const physics::Machine& described, const CheckedRuns& runs,
                 const DiagnoseOptions& options);

}  // namespace zerodrift::diagnosis::answer
