#pragma once
// The smallest size at which each effect would have shown in these recordings, and what follows from it: which effects
// they cannot show at all.

#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/search/stepwise_search.h"

namespace zerodrift::diagnosis::answer {

/// Of each effect its best form, beside the machine as described or else beside what was found: five standard
/// deviations of its amplitude with everything else free. No fit is made.
std::vector<Detectable> detection_limits(const search::Posterior& posterior);
/// Effects that act with inputs which are logged and never acted.
std::vector<std::string> never_driven(const search::Posterior& posterior, const std::vector<Detectable>& limits);
/// More than half of the effects would not have shown at the size that they usually have.
bool shows_too_little(const search::Posterior& posterior, const std::vector<Detectable>& limits);
/// Effects that would not have shown even as strong as they can be.
std::vector<std::string> cannot_show(const Diagnosis& answer);

}  // namespace zerodrift::diagnosis::answer
