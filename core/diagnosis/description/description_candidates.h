#pragma once
// The mistakes in the description by which a hypothesis could be extended, best first.

#include <memory>

#include "core/diagnosis/description/sensor_places.h"

namespace zerodrift::diagnosis::description {

/// `straight`: the description as it is, at the usual sizes of the discrepancy; `settled`: the same fitted. At most
/// `most`.
std::vector<PossibleError> description_candidates(const inference::Fit& straight, const inference::Fit& settled,
                                                  std::size_t most);

}  // namespace zerodrift::diagnosis::description
