#pragma once
// What one cycle cannot tell - how heat splits between bodies at other speeds - has to come from somewhere else: from
// the size of machines. The errors are expansions along the loop from tool to workpiece; a sensor stands for a part of
// it, so its coefficient is of the order of expansion x that part's length, either sign; and a machine of one material
// that is warmed as a whole keeps its shape, so the coefficients nearly add up to nothing (ISO 230-3 asks for that sum
// as the environmental variation; a few um/K are usual).
//
// The fit is the mean of the normal distribution that this prior and the run leave (a Gaussian process with a linear
// part; Rasmussen and Williams 2006, 2.7). Its covariance says what the run did not tell, so its deviation grows where
// bodies warm in other proportions: that is the band one cycle can honestly have.

#include <vector>

#include "core/analysis/linear.h"

namespace zerodrift::analysis {

struct StructuralPrior {
  double loop_um_per_K = 21.0;  // 2 m of cast iron (10.5 um/m/K) from tool to workpiece, shared by the sensors
  double sum_um_per_K = 1.5;    // deviation of the sum: uniform warming
  // What temperatures of surfaces do not tell of bodies: slow, this much of the error's range beside a fixed part.
  double scatter_share = 0.01;
  double scatter_um = 0.3;
  double scatter_memory_s = 3600.0;
  double fast_um = 0.2;  // and what the noise of readings leaves in their smoothed courses
};

/// Features are temperatures in K, one a sensor. Several errors measured in the same rows, one column each.
std::vector<RidgeFit> fit_structural(const Rows& rows, const Eigen::MatrixXd& errors_um,
                                     const StructuralPrior& prior = {});

/// `fits` with the deviation that they have in the eyes of the structural ones: what the run left open, and how far
/// both are apart. With `mean`, their coefficients become the mean of both: their errors point different ways.
void judge_by(const std::vector<RidgeFit>& structural, bool mean, std::vector<RidgeFit>& fits);

}  // namespace zerodrift::analysis
