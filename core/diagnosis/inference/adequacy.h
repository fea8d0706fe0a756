#pragma once
// Does a hypothesis leave more than it should? Under a right one with the discrepancy at its size, innovations are
// white and of unit variance, so that the squares of their sums over blocks follow chi-squared: a test whose
// significance is known (tests/diagnosis/adequacy_test.cpp simulates it).

#include <vector>

#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::inference {

/// Probability that sums over blocks as large as these come from white innovations. 0s, where nothing was measured, do
/// not count; 1 where there are too few.
double p_of_blocks(const std::vector<double>& innovations, const std::vector<bool>& present, std::size_t block);

/// The smallest of all series and recordings, at several lengths of block, corrected for how many were looked at
/// (Bonferroni).
double adequacy(const Fit& fit);

/// Probability that the unknowns of a right description are as far from what is known of them beforehand.
double bending(const Fit& fit);

}  // namespace zerodrift::diagnosis::inference
