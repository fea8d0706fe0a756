#pragma once
// What a reader of the answer has to know: what was assumed, what was not logged, what could not have shown.

#include "core/diagnosis/answer/posterior_summary.h"

namespace zerodrift::diagnosis::answer {

/// After everything else of the answer, detection limits too.
void add_notes(const PosteriorSummary& summary, Diagnosis& answer);

}  // namespace zerodrift::diagnosis::answer
