#pragma once
// Mistakes in the description that carry more than half of the posterior: what is said of them, and what they leave of
// the verdict.

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/search/stepwise_search.h"

namespace zerodrift::diagnosis::answer {

/// The note that says so.
NoteCode code_of(const DescriptionError& error);
/// `probability`: of each explanation. After effects and verdict; where the set-up is not as described no effect is
/// named, and with nothing named beside a mistake the description does not explain the recording.
void report_mistakes(const search::Posterior& posterior, const std::vector<double>& probability, Diagnosis& answer);

}  // namespace zerodrift::diagnosis::answer
