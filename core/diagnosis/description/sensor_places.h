#pragma once
// What every sensor would read at other places: a sensor elsewhere, two exchanged, all places in another unit, from
// another edge or from the other end. All of them are other readings of one simulation, so that hundreds cost little.

#include <vector>

#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::description {

struct PossibleError {
  DescriptionError error;
  double log_odds = 0.0;  // against the hypothesis without it: one linear step, with priors
};

/// Of each form the best value.
std::vector<PossibleError> sensor_errors(const inference::Fit& fit);

}  // namespace zerodrift::diagnosis::description
