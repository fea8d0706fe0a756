#include "core/vision/blur_match.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr double blur_limit_px2 = 0.25;    // a larger change of blur is put into the images and solved again
constexpr double largest_blur_px2 = 40.0;  // trace of the covariance
constexpr double usual_edge_px2 = 0.8;     // variance of an edge in a picture in focus
constexpr double largest_part = 0.45;
constexpr double least_blur_px2 = 0.1;  // along one axis, left to the blur columns
constexpr double round_blur_px2 = 0.3;  // nearer to round than this, the blur is made round, which is quicker
constexpr double with_field_px2 = 1.0;  // beside a field the solve's own blur columns do for a smaller change

// A target that moves evenly while it is exposed is smeared to a box, whose flanks are steeper than those of a normal
// distribution: a narrower one and the solve's second derivative for the rest suit it better than one of its variance.
constexpr double rest_of_smear = 0.45;  // of the variance put into the images
constexpr double across_smear = 0.15;   // of it, at most

// The solve sees of a blur the part that the second derivative tells. For an edge of variance s^2 that is further
// blurred by v it is q = 4 s^2 (1 - (1 + v / 2 s^2)^-1/2), by the integral over the edge's spectrum; this is its
// inverse.
double whole_change(double seen_px2, double edge_px2) {
  const double part = std::min(std::abs(seen_px2) / (4.0 * edge_px2), largest_part);
  return std::copysign(2.0 * edge_px2 * (1.0 / ((1.0 - part) * (1.0 - part)) - 1.0), seen_px2);
}

}  // namespace

bool match_blur(const Eigen::Matrix2d& extra_px2, bool may_be_smeared, ImageSetup& setup) {
  double limit = setup.with_field ? with_field_px2 : blur_limit_px2;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> seen(extra_px2);
  Eigen::Vector2d change = seen.eigenvalues();
  const Eigen::Matrix2d between = setup.template_blur - setup.frame_blur;
  const double along_px2 = seen.eigenvectors().col(1).dot(between * seen.eigenvectors().col(1));
  if (may_be_smeared && between.trace() - along_px2 < across_smear * along_px2) {
    limit = std::max(limit, rest_of_smear * along_px2);
  }
  if (change.cwiseAbs().maxCoeff() < limit) return false;
  if (change(1) - change(0) < round_blur_px2) change.setConstant(change.mean());
  const Eigen::Matrix2d& axes = seen.eigenvectors();
  for (int k = 0; k < 2; ++k) {
    if (std::abs(change(k)) < least_blur_px2) change(k) = 0.0;
    const Eigen::Matrix2d& there = change(k) > 0.0 ? setup.template_blur : setup.frame_blur;
    change(k) = whole_change(change(k), usual_edge_px2 + axes.col(k).dot(there * axes.col(k)));
  }
  ImageSetup next = setup;
  next.template_blur += axes * change.cwiseMax(0.0).asDiagonal() * axes.transpose();
  next.frame_blur += axes * (-change).cwiseMax(0.0).asDiagonal() * axes.transpose();
  if (std::max(next.template_blur.trace(), next.frame_blur.trace()) > largest_blur_px2) return false;
  setup = next;
  return true;
}

}  // namespace zerodrift::vision
