#pragma once
// The mistakes in the description by which a hypothesis could be extended, best first.

#include <memory>

#include "core/diagnosis/description/sensor_places.h"

namespace zerodrift::diagnosis::description {

/// `straight`: the description as it is - another machine is not reached from one that is bent; `usual`: fitted at the
/// usual sizes of the discrepancy; `settled`: at the likeliest. At most `most`.
std::vector<PossibleError> description_candidates(const inference::Fit& straight, const inference::Fit& usual,
                                                  const inference::Fit& settled, std::size_t most);

}  // namespace zerodrift::diagnosis::description
