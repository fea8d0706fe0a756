#pragma once
// Mistakes that make another machine or other inputs: a length, a diameter, all heat of a part, a displacement's sign,
// an effect that is not there, another clock - each value simulated once; and numbers whose tolerance is too small for
// what a fit makes of them, which needs no simulation.

#include "core/diagnosis/description/sensor_places.h"

namespace zerodrift::diagnosis::description {

/// Of each form the best value.
std::vector<PossibleError> machine_errors(const inference::Fit& fit);

/// `fit`: settled.
std::vector<PossibleError> number_errors(const inference::Fit& fit);

}  // namespace zerodrift::diagnosis::description
