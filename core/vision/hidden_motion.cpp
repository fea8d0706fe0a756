#include "core/vision/hidden_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr double length_px = 100.0;
constexpr double noise_known_to = 1.5;  // times: what the sampling folds down counts with it
constexpr double least_shown = 0.003;
constexpr double least_noise = 1e-6;
constexpr double mostly_turn = 0.5;  // of the direction's length

}  // namespace

HiddenMotion find_hidden_motion(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& fx,
                                const std::vector<float>& fy, double noise_variance) {
  using Motion = Eigen::Matrix<double, 6, 1>;
  using Normal = Eigen::Matrix<double, 6, 6>;
  Normal normal = Normal::Zero();
  Normal noise = Normal::Zero();
  for (std::size_t k = 0; k < x.size(); ++k) {
    const Eigen::Vector3d place(1.0, x[k] / length_px, y[k] / length_px);
    Motion row;
    row << fx[k], fy[k], fx[k] * place(1), fx[k] * place(2), fy[k] * place(1), fy[k] * place(2);
    normal.selfadjointView<Eigen::Lower>().rankUpdate(row);
    for (const bool along_x : {true, false}) {
      if ((along_x ? fx[k] : fy[k]) == 0.0f) continue;
      Motion part = Motion::Zero();
      part(along_x ? 0 : 1) = 1.0;
      part.segment<2>(along_x ? 2 : 4) = place.tail<2>();
      noise.selfadjointView<Eigen::Lower>().rankUpdate(part, noise_variance);
    }
  }
  normal = normal.selfadjointView<Eigen::Lower>();
  noise = noise.selfadjointView<Eigen::Lower>();
  noise.diagonal().array() += least_noise * normal.trace();
  // The translation that goes with each linear part so that the target changes least.
  const Eigen::Matrix<double, 2, 4> follows = -normal.topLeftCorner<2, 2>().ldlt().solve(normal.topRightCorner<2, 4>());
  Eigen::Matrix<double, 6, 4> both;
  both << follows, Eigen::Matrix4d::Identity();
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix4d> solved(both.transpose() * normal * both,
                                                                         both.transpose() * noise * both);
  HiddenMotion out;
  if (solved.info() != Eigen::Success || !solved.eigenvectors().col(0).allFinite()) return out;
  // Eigenvalues rise: the first is what is told least, over its noise.
  const Eigen::Vector4d least = solved.eigenvectors().col(0);
  const double turn = (least(2) - least(1)) / 2.0;
  if (turn * turn * 2.0 < mostly_turn * least.squaredNorm()) return out;
  out.direction = least / turn;
  out.shown = std::clamp(1.0 - noise_known_to / solved.eigenvalues()(0), least_shown, 1.0);
  return out;
}

}  // namespace zerodrift::vision
