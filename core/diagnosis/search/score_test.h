#pragma once
// Which effects could explain what a fitted hypothesis leaves: the efficient score (Rao 1948) of every candidate, with
// all unknowns and the gains of the repeatable discrepancy re-optimised beside it. All are derivatives of one
// simulation, so that a hundred candidates cost little more than one.

#include <vector>

#include "core/diagnosis/inference/fit.h"
#include "core/diagnosis/search/candidates.h"

namespace zerodrift::diagnosis::search {

struct Score {
  double log_odds = 0.0;     // against the hypothesis without it: one linear step, with prior and Occam factor
  std::vector<double> step;  // standardised amplitudes after that step
  double sigma = 0.0;        // standard deviation of the first amplitude, standardised
  double usual = 0.0;        // its prior standard deviation, in its own unit
};

/// In the order of the candidates; log odds of -1e300 where physics forbids the sign.
std::vector<Score> score_test(const inference::Fit& fit, const std::vector<Candidate>& candidates);

}  // namespace zerodrift::diagnosis::search
