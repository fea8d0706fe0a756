#include "app/proof/strength.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <future>
#include <utility>
#include <vector>

namespace zerodrift::proof {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

std::string_view name_of(StrengthRule rule) {
  return rule == StrengthRule::raw ? "raw" : rule == StrengthRule::shown ? "shown" : "left";
}

std::optional<StrengthRule> strength_rule_from(std::string_view name) {
  for (const StrengthRule rule : {StrengthRule::raw, StrengthRule::shown, StrengthRule::left}) {
    if (name == name_of(rule)) return rule;
  }
  return std::nullopt;
}

MatrixXd sensitivities_of(const Rival& rival, int count, const MatrixXd& at_zero) {
  constexpr double step = 0.2;  // tolerances
  std::vector<std::future<MatrixXd>> moved;
  for (Index j = 0; j < count; ++j) {
    moved.push_back(std::async(std::launch::async, [&, j] { return rival(step * VectorXd::Unit(count, j)); }));
  }
  MatrixXd columns(at_zero.size(), count);
  for (Index j = 0; j < count; ++j) {
    columns.col(j) = ((moved[static_cast<std::size_t>(j)].get() - at_zero) / step).reshaped();
  }
  return columns;
}

MatrixXd left_after_refit(const MatrixXd& seen, const Rival& rival, const MatrixXd& at_zero, MatrixXd slopes) {
  const Index count = slopes.cols();
  VectorXd z = VectorXd::Zero(count);
  MatrixXd left = seen - at_zero;
  double cost = left.squaredNorm();
  constexpr int steps = 12;
  constexpr double furthest = 4.0;  // tolerances a step
  double share = 1.0;
  for (int k = 0; k < steps && share > 0.1; ++k) {
    const MatrixXd curvature = slopes.transpose() * slopes + MatrixXd::Identity(count, count);
    VectorXd step = share * curvature.ldlt().solve(slopes.transpose() * left.reshaped() - z);
    step *= std::min(1.0, furthest / std::max(1e-9, step.lpNorm<Eigen::Infinity>()));
    const MatrixXd rest = seen - rival(z + step);
    // Broyden: the slopes learn from every run.
    const VectorXd unforeseen = (left - rest).reshaped() - slopes * step;
    slopes += unforeseen * step.transpose() / step.squaredNorm();
    const double now = rest.squaredNorm() + (z + step).squaredNorm();
    if (now >= cost) {
      share *= 0.5;
      continue;
    }
    const bool settled = now > 0.98 * cost;
    z += step;
    left = rest;
    cost = now;
    if (settled) break;
  }
  return left;
}

double largest_rms(const MatrixXd& change) {
  return std::sqrt(change.colwise().squaredNorm().maxCoeff() / static_cast<double>(change.rows()));
}

}  // namespace zerodrift::proof
