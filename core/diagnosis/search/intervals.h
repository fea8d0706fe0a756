#pragma once
// When something acted that nothing logged: heat in a part, a stronger film, a sensor that read wrong. Each could act
// in any stretches of a recording. Its strength over time is cut into short hats; the response to a stretch is the sum
// of its hats, so that the efficient score of every stretch comes from one matrix (a generalised likelihood-ratio
// scan). The best stretches, one or several, are candidates like any other.

#include <vector>

#include "core/diagnosis/inference/fit.h"
#include "core/diagnosis/search/candidates.h"
#include "core/diagnosis/search/hat_scores.h"

namespace zerodrift::diagnosis::search {

/// Hats [first, last] in which it acts, of one strength; best first added. `sigma`: prior of the strength.
/// `stretch_cost`:
/// log odds that each further stretch has to gain.
std::vector<std::pair<int, int>> best_stretches(const HatScores& scores, double sigma, bool only_positive,
                                                double stretch_cost);

/// Candidates with intervals, for what a fit leaves of each recording.
std::vector<Candidate> interval_candidates(const inference::Fit& fit, const std::vector<physics::RunFacts>& facts);

}  // namespace zerodrift::diagnosis::search
