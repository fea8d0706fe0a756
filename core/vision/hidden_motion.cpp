#include "core/vision/hidden_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/vision/row_sums.h"

namespace zerodrift::vision {
namespace {

constexpr double length_px = 100.0;
constexpr double noise_known_to = 1.5;  // times: what the sampling folds down counts with it
constexpr double least_shown = 0.003;
constexpr double least_noise = 1e-6;
constexpr double mostly_turn = 0.5;  // of the direction's length

using Normal = Eigen::Matrix<double, 6, 6>;

// Of the translation and the four linear parts, from moments over 1, x, y, x^2, x y, y^2.
Normal normal_of(const double* xx, const double* xy, const double* yy) {
  const auto over_places = [](const double* m) {
    constexpr double one = 1.0 / length_px;
    constexpr double two = one * one;
    Eigen::Matrix3d out;
    out << m[0], one * m[1], one * m[2], one * m[1], two * m[3], two * m[4], one * m[2], two * m[4], two * m[5];
    return out;
  };
  Eigen::Matrix<double, 6, 6> by_gradient;  // 1, x, y times fx, then times fy
  const Eigen::Matrix3d cross = over_places(xy);
  by_gradient << over_places(xx), cross, cross, over_places(yy);
  constexpr int order[] = {0, 3, 1, 2, 4, 5};
  Normal out;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 6; ++j) out(i, j) = by_gradient(order[i], order[j]);
  }
  return out;
}

}  // namespace

HiddenMotion find_hidden_motion(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& fx,
                                const std::vector<float>& fy, double noise_variance) {
  GradientMoments sums;
  add_moments(x.data(), y.data(), fx.data(), fy.data(), static_cast<int>(x.size()), sums);
  const Normal normal = normal_of(sums.xx, sums.xy, sums.yy);
  const double none[6] = {};
  Normal noise = noise_variance * normal_of(sums.along_x, none, sums.along_y);
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
