#include "core/analysis/regressions.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/analysis/statistics.h"

namespace zerodrift::analysis {
namespace {

constexpr int validation_blocks = 5;

/// Mean, scale and intercept filled in; z receives the standardised features.
RidgeFit standardise(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, Eigen::MatrixXd& z) {
  RidgeFit fit;
  fit.mean = x.colwise().mean().transpose();
  z = x.rowwise() - fit.mean.transpose();
  fit.scale = (z.colwise().squaredNorm().transpose() / static_cast<double>(x.rows())).cwiseSqrt();
  for (double& s : fit.scale) {
    if (!(s > 1e-9)) s = 1e9;  // a feature that never moved says nothing about states where it does
  }
  z = z * fit.scale.cwiseInverse().asDiagonal();
  fit.intercept = y.mean();
  return fit;
}

void set_sigma(RidgeFit& fit, const Eigen::MatrixXd& z, const Eigen::VectorXd& y, double parameters) {
  const double square = (y.array() - fit.intercept - (z * fit.beta).array()).matrix().squaredNorm();
  fit.sigma_um = std::sqrt(square / std::max(static_cast<double>(y.size()) - parameters - 1.0, 1.0));
}

/// Coefficients for every setting to choose from, one column each, of standardised features and centred errors.
using Path = std::function<Eigen::MatrixXd(const Eigen::MatrixXd& z, const Eigen::VectorXd& y)>;

/// Setting with the least error over blocks left out in turn.
Eigen::Index best_setting(const Eigen::MatrixXd& z, const Eigen::VectorXd& y, const Path& path) {
  const Eigen::Index n = y.size();
  Eigen::VectorXd square;
  for (int block = 0; block < validation_blocks; ++block) {
    const Eigen::Index from = n * block / validation_blocks;
    const Eigen::Index to = n * (block + 1) / validation_blocks;
    Eigen::MatrixXd z_in(n - (to - from), z.cols());
    Eigen::VectorXd y_in(n - (to - from));
    z_in << z.topRows(from), z.bottomRows(n - to);
    y_in << y.head(from), y.tail(n - to);
    const Eigen::RowVectorXd z_mean = z_in.colwise().mean();
    const double y_mean = y_in.mean();
    const Eigen::MatrixXd betas = path(z_in.rowwise() - z_mean, Eigen::VectorXd(y_in.array() - y_mean));
    const Eigen::MatrixXd predicted = (z.middleRows(from, to - from).rowwise() - z_mean) * betas;
    const Eigen::VectorXd truth = y.segment(from, to - from).array() - y_mean;
    const Eigen::VectorXd squares = (predicted.colwise() - truth).colwise().squaredNorm().transpose();
    if (square.size() == 0) square = Eigen::VectorXd::Zero(squares.size());
    square += squares;
  }
  Eigen::Index best = 0;
  square.minCoeff(&best);
  return best;
}

/// Column k: on the first k + 1 principal components.
Eigen::MatrixXd component_path(const Eigen::MatrixXd& z, const Eigen::VectorXd& y, Eigen::Index most) {
  const ThinSvd svd = thin_svd(z);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(z.cols(), most);
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(z.cols());
  for (Eigen::Index k = 0; k < most; ++k) {
    if (k < svd.s.size() && svd.s(k) > 1e-8 * svd.s(0)) beta += svd.v.col(k) * (svd.u.col(k).dot(y) / svd.s(k));
    out.col(k) = beta;
  }
  return out;
}

double soft(double value, double threshold) {
  return value > threshold ? value - threshold : value < -threshold ? value + threshold : 0.0;
}

/// Column k: penalty shares[k] of the one at which every coefficient vanishes; from strong to weak, each from the last.
Eigen::MatrixXd lasso_path(const Eigen::MatrixXd& z, const Eigen::VectorXd& y, const std::vector<double>& shares) {
  const Eigen::MatrixXd gram = z.transpose() * z;
  const Eigen::VectorXd zy = z.transpose() * y;
  const double strongest = zy.cwiseAbs().maxCoeff();
  Eigen::VectorXd beta = Eigen::VectorXd::Zero(z.cols());
  Eigen::MatrixXd out(z.cols(), static_cast<Eigen::Index>(shares.size()));
  for (std::size_t k = 0; k < shares.size(); ++k) {
    for (int sweep = 0; sweep < 500; ++sweep) {
      double moved = 0.0;
      for (Eigen::Index j = 0; j < z.cols(); ++j) {
        if (gram(j, j) <= 0.0) continue;
        const double pull = zy(j) - gram.col(j).dot(beta) + gram(j, j) * beta(j);
        const double now = soft(pull, shares[k] * strongest) / gram(j, j);
        moved = std::max(moved, std::abs(now - beta(j)));
        beta(j) = now;
      }
      if (moved < 1e-6 * beta.cwiseAbs().maxCoeff()) break;
    }
    out.col(static_cast<Eigen::Index>(k)) = beta;
  }
  return out;
}

/// The fit of some columns as a fit of all of them: the others count nothing.
RidgeFit embedded(const RidgeFit& part, const std::vector<int>& columns, Eigen::Index all) {
  RidgeFit out = part;
  out.mean = Eigen::VectorXd::Zero(all);
  out.scale = Eigen::VectorXd::Ones(all);
  out.beta = Eigen::VectorXd::Zero(all);
  out.covariance = Eigen::MatrixXd::Zero(all, all);
  out.mean(columns) = part.mean;
  out.scale(columns) = part.scale;
  out.beta(columns) = part.beta;
  out.covariance(columns, columns) = part.covariance;
  return out;
}

}  // namespace

RidgeFit fit_multiple(const Eigen::MatrixXd& x, const Eigen::VectorXd& y) {
  Eigen::MatrixXd z;
  RidgeFit fit = standardise(x, y, z);
  fit.beta = least_squares(z, Eigen::VectorXd(y.array() - fit.intercept)).coefficient;
  set_sigma(fit, z, y, static_cast<double>(z.cols()));
  const ThinSvd svd = thin_svd(z);
  const Eigen::ArrayXd s = svd.s.array();
  const Eigen::ArrayXd inverse = (s > 1e-8 * s(0)).select(s.square().inverse(), 0.0);
  fit.covariance = svd.v * inverse.matrix().asDiagonal() * svd.v.transpose();
  return fit;
}

RidgeFit fit_components(const Eigen::MatrixXd& x, const Eigen::VectorXd& y) {
  Eigen::MatrixXd z;
  RidgeFit fit = standardise(x, y, z);
  const Eigen::VectorXd centred = y.array() - fit.intercept;
  const Eigen::Index most = std::min<Eigen::Index>(z.cols(), y.size() / 2);
  const Path path = [most](const auto& a, const auto& b) { return component_path(a, b, most); };
  const Eigen::Index count = best_setting(z, centred, path) + 1;
  fit.beta = path(z, centred).col(count - 1);
  set_sigma(fit, z, y, static_cast<double>(count));
  const ThinSvd svd = thin_svd(z);
  const Eigen::MatrixXd v = svd.v.leftCols(count);
  fit.covariance = v * svd.s.head(count).cwiseAbs2().cwiseMax(1e-12).cwiseInverse().asDiagonal() * v.transpose();
  return fit;
}

RidgeFit fit_lasso(const Eigen::MatrixXd& x, const Eigen::VectorXd& y) {
  Eigen::MatrixXd z;
  RidgeFit fit = standardise(x, y, z);
  const Eigen::VectorXd centred = y.array() - fit.intercept;
  std::vector<double> shares;
  for (int k = 0; k < 25; ++k) shares.push_back(std::pow(10.0, -k / 6.0));
  const Path path = [&shares](const auto& a, const auto& b) { return lasso_path(a, b, shares); };
  const Eigen::Index setting = best_setting(z, centred, path);
  fit.penalty = shares[static_cast<std::size_t>(setting)];
  fit.beta = path(z, centred).col(setting);
  std::vector<int> used;
  for (Eigen::Index j = 0; j < fit.beta.size(); ++j) {
    if (fit.beta(j) != 0.0) used.push_back(static_cast<int>(j));
  }
  set_sigma(fit, z, y, static_cast<double>(used.size()));
  fit.covariance = Eigen::MatrixXd::Zero(z.cols(), z.cols());
  if (!used.empty()) {
    Eigen::MatrixXd gram = z(Eigen::all, used).transpose() * z(Eigen::all, used);
    gram.diagonal().array() *= 1.0 + 1e-9;
    const Eigen::MatrixXd inverse = gram.llt().solve(Eigen::MatrixXd::Identity(gram.rows(), gram.cols()));
    fit.covariance(used, used) = inverse;
  }
  return fit;
}

RidgeFit fit_robust(const Rows& rows) {
  constexpr double tuning = 1.345;  // 95 % efficient when the noise is normal (Huber 1964)
  constexpr int most_iterations = 25;
  RidgeChoice choice = default_choice(0.0);
  std::erase_if(choice.noises, [](const NoiseModel& m) { return m.memory_s > 0.0 && m.nugget > 0.001; });
  RidgeFit fit = fit_ridge(rows, choice);
  Rows pulled_in = rows;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    const Eigen::VectorXd predicted = fit.predict(rows.x);
    const Eigen::ArrayXd residual = rows.y - predicted;
    std::vector<double> sizes;
    for (const double r : residual) sizes.push_back(std::abs(r));
    const double reach_um = tuning * std::max(1.4826 * median(std::move(sizes)), 1e-9);
    pulled_in.y = predicted + residual.min(reach_um).max(-reach_um).matrix();
    fit = fit_ridge(pulled_in, choice);
    const double moved_um = (fit.predict(rows.x) - predicted).cwiseAbs().maxCoeff();
    if (moved_um < 0.01 * reach_um) break;
  }
  fit.noise = {};  // a controller's model: what the noise remembers is not used
  return fit;
}

std::vector<RidgeFit> fit_poles(const Rows& rows, const Eigen::MatrixXd& errors_um,
                                const std::vector<std::vector<int>>& groups, double duration_s) {
  RidgeChoice choice = default_choice(duration_s);
  // The noise is chosen from few (with the nugget that is never ruled out): there are many groups, and each noise costs
  // a factorisation.
  std::erase_if(choice.noises, [](const NoiseModel& m) { return m.memory_s > 0.0 && m.nugget > 0.001; });
  std::vector<RidgeFit> best(static_cast<std::size_t>(errors_um.cols()));
  for (auto& fit : best) fit.likelihood = -std::numeric_limits<double>::infinity();
  for (const auto& columns : groups) {
    Rows part = rows;
    part.x = rows.x(Eigen::all, columns);
    const std::vector<RidgeFit> fits = fit_ridge(part, errors_um, choice);
    for (std::size_t e = 0; e < fits.size(); ++e) {
      if (fits[e].likelihood > best[e].likelihood) best[e] = embedded(fits[e], columns, rows.x.cols());
    }
  }
  return best;
}

std::vector<RidgeFit> mean_of(const std::vector<std::vector<RidgeFit>>& members, Eigen::Index columns) {
  const auto padded = [columns](const Eigen::VectorXd& v) {
    Eigen::VectorXd out = Eigen::VectorXd::Zero(columns);
    out.head(v.size()) = v;
    return out;
  };
  const auto count = static_cast<double>(members.size());
  std::vector<RidgeFit> out = members.back();
  for (std::size_t e = 0; e < out.size(); ++e) {
    RidgeFit& mean = out[e];
    const auto largest = std::max_element(members.begin(), members.end(), [e](const auto& a, const auto& b) {
      return a[e].mean.size() < b[e].mean.size();
    });
    mean = (*largest)[e];
    mean.noise = {};
    mean.beta = Eigen::VectorXd::Zero(columns);
    mean.intercept = mean.sigma_um = 0.0;
    for (const auto& member : members) {
      mean.beta += padded(member[e].beta) / count;
      mean.intercept += member[e].intercept / count;
      mean.sigma_um += member[e].sigma_um / count;
    }
    if (!(mean.sigma_um > 0.0)) continue;
    for (const auto& member : members) {
      const Eigen::VectorXd apart = (padded(member[e].beta) - mean.beta) / mean.sigma_um;
      mean.covariance += apart * apart.transpose() / count;
    }
  }
  return out;
}

}  // namespace zerodrift::analysis
