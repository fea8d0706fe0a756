#pragma once
// From the posterior to the answer: which effects carry how much of its mass, what each channel is left with, where and
// when heat is missing, and the description that says so.

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/search/stepwise_search.h"

namespace zerodrift::diagnosis::answer {

/// `recordings`: whole, in the order of the posterior's runs.
Diagnosis assess(const search::Posterior& posterior, const physics::Machine& described,
                 const std::vector<recording::Recording>& recordings, const DiagnoseOptions& options);

}  // namespace zerodrift::diagnosis::answer
