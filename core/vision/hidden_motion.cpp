#include "core/vision/hidden_motion.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/vision/row_sums.h"

namespace zerodrift::vision {
namespace {

constexpr float length_px = 100.0f;
constexpr double noise_known_to = 1.5;  // times: what the sampling folds down counts with it
constexpr double least_shown = 0.003;
constexpr double least_noise = 1e-6;
constexpr double mostly_turn = 0.5;  // of the direction's length

}  // namespace

HiddenMotion find_hidden_motion(const std::vector<float>& x, const std::vector<float>& y, const std::vector<float>& fx,
                                const std::vector<float>& fy, double noise_variance) {
  using Normal = Eigen::Matrix<double, 6, 6>;
  using Squares = Eigen::Matrix<double, row_length, row_length>;
  // Of each pixel what the six motions change, then (1, x, y) where it shows a motion along x, and along y.
  constexpr int chunk = 512;
  Eigen::Matrix<float, row_length, chunk> rows = Eigen::Matrix<float, row_length, chunk>::Zero();
  const Eigen::Matrix<float, chunk, 1> ones = Eigen::Matrix<float, chunk, 1>::Ones();
  Squares squares = Squares::Zero();
  for (std::size_t first = 0; first < x.size(); first += chunk) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk, x.size() - first));
    for (int i = 0; i < count; ++i) {
      const std::size_t k = first + i;
      const float across = x[k] / length_px;
      const float down = y[k] / length_px;
      const float along_x = fx[k] == 0.0f ? 0.0f : 1.0f;
      const float along_y = fy[k] == 0.0f ? 0.0f : 1.0f;
      rows.col(i).head<12>() << fx[k], fy[k], fx[k] * across, fx[k] * down, fy[k] * across, fy[k] * down, along_x,
          along_x * across, along_x * down, along_y, along_y * across, along_y * down;
    }
    add_squares(rows.data(), ones.data(), count, squares.data());
  }
  const Normal normal = squares.topLeftCorner<6, 6>();
  Normal noise = Normal::Zero();
  constexpr int parts[2][3] = {{0, 2, 3}, {1, 4, 5}};
  for (int axis = 0; axis < 2; ++axis) {
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        noise(parts[axis][i], parts[axis][j]) = noise_variance * squares(6 + 3 * axis + i, 6 + 3 * axis + j);
      }
    }
  }
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
