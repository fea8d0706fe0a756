#include "core/analysis/structural.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace zerodrift::analysis {
namespace {

/// Independent coefficients of equal deviation, conditioned on what their sum is known to.
Eigen::MatrixXd prior_covariance(Eigen::Index sensors, const StructuralPrior& prior) {
  const auto n = static_cast<double>(sensors);
  const double variance = std::pow(prior.loop_um_per_K / n, 2);
  const double sum_variance = prior.sum_um_per_K * prior.sum_um_per_K;
  const double shared = variance * variance / (n * variance + sum_variance);
  return variance * Eigen::MatrixXd::Identity(sensors, sensors) - shared * Eigen::MatrixXd::Ones(sensors, sensors);
}

Eigen::MatrixXd correlation(const Rows& rows, double memory_s) {
  Eigen::MatrixXd k(rows.x.rows(), rows.x.rows());
  for (Eigen::Index i = 0; i < k.rows(); ++i) {
    for (Eigen::Index j = 0; j < k.cols(); ++j) {
      const auto a = static_cast<std::size_t>(i);
      const auto b = static_cast<std::size_t>(j);
      const double dt_s = std::abs(rows.time_s[a] - rows.time_s[b]);
      k(i, j) = rows.run[a] == rows.run[b] ? std::exp(-dt_s / memory_s) : 0.0;
    }
  }
  return k;
}

}  // namespace

std::vector<RidgeFit> fit_structural(const Rows& rows, const Eigen::MatrixXd& errors_um, const StructuralPrior& prior) {
  RidgeFit start;
  start.mean = rows.x.colwise().mean().transpose();
  const Eigen::MatrixXd x = rows.x.rowwise() - start.mean.transpose();
  start.scale = feature_scale(x);
  start.noise.memory_s = prior.scatter_memory_s;
  const Eigen::MatrixXd before = prior_covariance(x.cols(), prior);
  const Eigen::MatrixXd cross = x * before;
  const Eigen::MatrixXd explained = cross * x.transpose();
  const Eigen::MatrixXd memory = correlation(rows, prior.scatter_memory_s);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(x.rows());
  std::vector<RidgeFit> out;
  for (Eigen::Index e = 0; e < errors_um.cols(); ++e) {
    RidgeFit fit = start;
    const Eigen::VectorXd y = errors_um.col(e);
    fit.sigma_um = std::hypot(prior.scatter_um, prior.scatter_share * (y.maxCoeff() - y.minCoeff()));
    const double white = white_variance(rows, y) + prior.fast_um * prior.fast_um;
    fit.noise.nugget = white / (fit.sigma_um * fit.sigma_um);
    Eigen::MatrixXd v = explained + fit.sigma_um * fit.sigma_um * memory;
    v.diagonal().array() += white;
    const Eigen::LLT<Eigen::MatrixXd> llt(v);
    const Eigen::VectorXd weights = llt.solve(ones);
    fit.intercept = weights.dot(y) / weights.sum();
    const Eigen::VectorXd um_per_K = cross.transpose() * llt.solve(y - fit.intercept * ones);
    fit.beta = um_per_K.cwiseProduct(fit.scale);
    const Eigen::MatrixXd after = before - cross.transpose() * llt.solve(cross);
    fit.covariance = fit.scale.asDiagonal() * after * fit.scale.asDiagonal() / (fit.sigma_um * fit.sigma_um);
    out.push_back(std::move(fit));
  }
  return out;
}

void judge_by(const std::vector<RidgeFit>& structural, bool mean, std::vector<RidgeFit>& fits) {
  for (std::size_t e = 0; e < fits.size(); ++e) {
    const RidgeFit& judge = structural[e];
    RidgeFit& fit = fits[e];
    if (mean) {
      fit.beta = 0.5 * (fit.beta + judge.beta);
      fit.intercept = 0.5 * (fit.intercept + judge.intercept);
    }
    // One noise of a controller's table: the scatter and the white part together, nothing remembered.
    const double sigma_um = judge.sigma_um * std::sqrt(1.0 + judge.noise.nugget);
    const Eigen::VectorXd apart = (fit.beta - judge.beta) / sigma_um;
    fit.covariance = judge.covariance / (1.0 + judge.noise.nugget) + apart * apart.transpose();
    fit.sigma_um = sigma_um;
    fit.noise = {};
  }
}

}  // namespace zerodrift::analysis
