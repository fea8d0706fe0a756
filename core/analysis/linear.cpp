#include "core/analysis/linear.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/analysis/statistics.h"

namespace zerodrift::analysis {
namespace {

Eigen::MatrixXd noise_matrix(const NoiseModel& noise, const Rows& rows) {
  const Eigen::Index n = rows.x.rows();
  Eigen::MatrixXd k = Eigen::MatrixXd::Identity(n, n);
  if (noise.memory_s <= 0.0) return k;
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < i; ++j) {
      const bool same = rows.run[static_cast<std::size_t>(i)] == rows.run[static_cast<std::size_t>(j)];
      const double dt_s = rows.time_s[static_cast<std::size_t>(i)] - rows.time_s[static_cast<std::size_t>(j)];
      k(i, j) = k(j, i) = same ? std::exp(-std::abs(dt_s) / noise.memory_s) : 0.0;
    }
    k(i, i) = 1.0 + noise.nugget;
  }
  return k;
}

/// The regression after the noise is made white and the intercept is taken out: features a, errors y, in the basis v of
/// eigenvectors of a'a, where every penalty is a division.
struct Whitened {
  Eigen::VectorXd ones;
  Eigen::MatrixXd y;  // one column an error
  Eigen::MatrixXd x;
  Eigen::MatrixXd v;
  Eigen::ArrayXd square;  // eigenvalues
  Eigen::MatrixXd vay;    // v'a'y
  Eigen::VectorXd y_square;
  double log_determinant = 0.0;
  double ones_square = 0.0;
};

Whitened whiten(const NoiseModel& noise, const Rows& rows, const Eigen::MatrixXd& standardised,
                const Eigen::MatrixXd& errors_um) {
  Whitened w;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(noise_matrix(noise, rows));
  w.ones = cholesky.matrixL().solve(Eigen::VectorXd::Ones(rows.x.rows()));
  w.ones_square = w.ones.squaredNorm();
  w.y = cholesky.matrixL().solve(errors_um);
  w.x = cholesky.matrixL().solve(standardised);
  w.log_determinant = 2.0 * Eigen::MatrixXd(cholesky.matrixL()).diagonal().array().log().sum();
  const Eigen::MatrixXd y = w.y - w.ones * ((w.ones.transpose() * w.y) / w.ones_square);
  const Eigen::MatrixXd a = w.x - w.ones * ((w.ones.transpose() * w.x) / w.ones_square);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(a.transpose() * a);
  w.v = eigen.eigenvectors();
  // What rounding leaves of directions without any excitation counts as none.
  w.square = eigen.eigenvalues().array().max(1e-13 * eigen.eigenvalues().maxCoeff());
  w.vay = w.v.transpose() * (a.transpose() * y);
  w.y_square = y.colwise().squaredNorm().transpose();
  return w;
}

double noise_variance(const Whitened& w, Eigen::Index error, double penalty) {
  const double explained = (w.vay.col(error).array().square() / (w.square + penalty)).sum();
  return std::max((w.y_square(error) - explained) / static_cast<double>(w.y.rows() - 1), 1e-20);
}

double log_likelihood(const Whitened& w, Eigen::Index error, double penalty) {
  const auto freedom = static_cast<double>(w.y.rows() - 1);
  return -0.5 * (freedom * std::log(noise_variance(w, error, penalty)) + (1.0 + w.square / penalty).log().sum() +
                 w.log_determinant + std::log(w.ones_square));
}

/// A noise model is out when it calls more of the residual white than neighbouring measurements can scatter.
bool contradicts(const NoiseModel& noise, double variance, double largest_white) {
  constexpr double generous = 4.0;
  constexpr double always_allowed = 0.001;
  if (noise.memory_s > 0.0 && noise.nugget <= always_allowed) return false;
  return (noise.memory_s > 0.0 ? noise.nugget : 1.0) * variance > generous * largest_white;
}

/// Coefficients and their uncertainty, with the noise model and the penalty already chosen.
void solve(const Whitened& w, Eigen::Index error, RidgeFit& fit) {
  fit.beta = w.v * (w.vay.col(error).array() / (w.square + fit.penalty)).matrix();
  fit.intercept = w.ones.dot(w.y.col(error) - w.x * fit.beta) / w.ones_square;
  fit.sigma_um = std::sqrt(noise_variance(w, error, fit.penalty));
  // Prior variance 1 / penalty, reduced in the directions that the run excited.
  fit.covariance = w.v * (w.square + fit.penalty).inverse().matrix().asDiagonal() * w.v.transpose();
}

}  // namespace

LeastSquares least_squares(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, bool about_mean) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  LeastSquares out;
  Matrix a = x.cast<long double>();
  Vector scale = a.colwise().norm().transpose();
  for (Eigen::Index c = 0; c < a.cols(); ++c) {
    if (scale(c) == 0.0L) scale(c) = 1.0L;
    a.col(c) /= scale(c);
  }
  Eigen::ColPivHouseholderQR<Matrix> qr(a);
  qr.setThreshold(1e-16L * static_cast<long double>(a.rows()));
  const Vector b = y.cast<long double>();
  Vector solution = qr.solve(b);
  solution += qr.solve(Vector(b - a * solution));  // one step of refinement
  const Vector residual = b - a * solution;
  out.rank = static_cast<int>(qr.rank());
  const auto freedom = static_cast<long double>(a.rows() - qr.rank());
  const long double variance = freedom > 0 ? residual.squaredNorm() / freedom : 0.0L;
  out.residual_deviation = static_cast<double>(std::sqrt(variance));
  const long double total = about_mean ? (b.array() - b.mean()).matrix().squaredNorm() : b.squaredNorm();
  out.r_squared = total > 0 ? static_cast<double>(1.0L - residual.squaredNorm() / total) : 0.0;
  const Eigen::Index rank = qr.rank();
  const Matrix r = qr.matrixR().topLeftCorner(rank, rank).template triangularView<Eigen::Upper>();
  const Matrix inverse = r.template triangularView<Eigen::Upper>().solve(Matrix::Identity(rank, rank));
  Vector errors = Vector::Zero(a.cols());
  for (Eigen::Index k = 0; k < rank; ++k) {
    errors(qr.colsPermutation().indices()(k)) = std::sqrt(variance * inverse.row(k).squaredNorm());
  }
  out.coefficient = solution.cwiseQuotient(scale).cast<double>();
  out.standard_error = errors.cwiseQuotient(scale).cast<double>();
  return out;
}

Rows pick(const Rows& rows, const std::vector<int>& which) {
  Rows out;
  out.x.resize(static_cast<Eigen::Index>(which.size()), rows.x.cols());
  out.y.resize(static_cast<Eigen::Index>(which.size()));
  for (std::size_t i = 0; i < which.size(); ++i) {
    const auto from = static_cast<std::size_t>(which[i]);
    out.x.row(static_cast<Eigen::Index>(i)) = rows.x.row(which[i]);
    out.y(static_cast<Eigen::Index>(i)) = rows.y(which[i]);
    out.time_s.push_back(rows.time_s[from]);
    out.run.push_back(rows.run[from]);
  }
  return out;
}

double white_variance(const Rows& rows, const Eigen::VectorXd& y) {
  std::vector<double> differences;
  for (Eigen::Index i = 1; i + 1 < y.size(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (rows.run[at - 1] != rows.run[at + 1]) continue;
    differences.push_back(std::abs(y(i - 1) - 2.0 * y(i) + y(i + 1)));
  }
  const double deviation = 1.4826 * median(std::move(differences));
  return deviation * deviation / 6.0;
}

Eigen::VectorXd feature_scale(const Eigen::MatrixXd& centred) {
  Eigen::VectorXd scale =
      (centred.colwise().squaredNorm().transpose() / static_cast<double>(centred.rows())).cwiseSqrt();
  for (double& s : scale) {
    if (!(s > 1e-9)) s = 1e9;
  }
  return scale;
}

RidgeChoice default_choice(double duration_s) {
  RidgeChoice choice;
  choice.noises.push_back({0.0, 0.0});
  for (const double hours : {0.5, 1.0, 2.0, 4.0, 8.0}) {
    if (hours * 3600.0 * 3.0 > duration_s && hours > 0.5) continue;
    for (const double nugget : {0.001, 0.01, 0.1}) choice.noises.push_back({hours * 3600.0, nugget});
  }
  for (int k = -8; k <= 8; ++k) choice.penalties.push_back(std::pow(10.0, 0.5 * k));
  return choice;
}

std::vector<RidgeFit> fit_ridge(const Rows& rows, const Eigen::MatrixXd& errors_um, const RidgeChoice& choice) {
  RidgeFit start;
  start.mean = rows.x.colwise().mean().transpose();
  Eigen::MatrixXd z = rows.x.rowwise() - start.mean.transpose();
  start.scale = feature_scale(z);
  z = z * start.scale.cwiseInverse().asDiagonal();
  start.likelihood = -std::numeric_limits<double>::infinity();
  std::vector<RidgeFit> fits(static_cast<std::size_t>(errors_um.cols()), start);
  std::vector<double> white;
  for (Eigen::Index e = 0; e < errors_um.cols(); ++e) white.push_back(white_variance(rows, errors_um.col(e)));
  for (const auto& noise : choice.noises) {
    const Whitened w = whiten(noise, rows, z, errors_um);
    for (Eigen::Index e = 0; e < errors_um.cols(); ++e) {
      RidgeFit& fit = fits[static_cast<std::size_t>(e)];
      bool better = false;
      for (const double penalty : choice.penalties) {
        const double likelihood = log_likelihood(w, e, penalty);
        if (likelihood <= fit.likelihood) continue;
        if (contradicts(noise, noise_variance(w, e, penalty), white[static_cast<std::size_t>(e)])) continue;
        fit.likelihood = likelihood;
        fit.penalty = penalty;
        fit.noise = noise;
        better = true;
      }
      if (better) solve(w, e, fit);
    }
  }
  return fits;
}

RidgeFit fit_ridge(const Rows& rows, const RidgeChoice& choice) {
  return fit_ridge(rows, rows.y, choice).front();
}

Eigen::VectorXd RidgeFit::predict(const Eigen::MatrixXd& x) const {
  return ((x * raw_coefficients()).array() + raw_intercept()).matrix();
}

Eigen::VectorXd RidgeFit::deviation(const Eigen::MatrixXd& x) const {
  const Eigen::MatrixXd z = (x.rowwise() - mean.transpose()) * scale.cwiseInverse().asDiagonal();
  const Eigen::ArrayXd leverage = (z * covariance).cwiseProduct(z).rowwise().sum().array().max(0.0);
  return (sigma_um * (1.0 + noise.nugget + leverage).sqrt()).matrix();
}

RidgeFit for_noisy_readings(const RidgeFit& fit, const Eigen::MatrixXd& x, const Eigen::VectorXd& noise) {
  const Eigen::MatrixXd z = (x.rowwise() - fit.mean.transpose()) * fit.scale.cwiseInverse().asDiagonal();
  const Eigen::MatrixXd moment = z.transpose() * z / static_cast<double>(z.rows());
  Eigen::MatrixXd noisy = moment;
  noisy.diagonal() += noise.cwiseQuotient(fit.scale).cwiseAbs2();
  noisy.diagonal().array() += 1e-12;  // a feature that never moved, read without noise
  RidgeFit out = fit;
  out.beta = noisy.llt().solve(moment * fit.beta);
  if (fit.sigma_um > 0.0) {
    const Eigen::VectorXd given_up = (fit.beta - out.beta) / fit.sigma_um;
    out.covariance += given_up * given_up.transpose();
  }
  return out;
}

double remembered_um(const RidgeFit& fit, const Rows& past, double time_s, int run) {
  if (fit.noise.memory_s <= 0.0) return 0.0;
  std::vector<int> mine;
  for (int i = 0; i < past.size(); ++i) {
    if (past.run[static_cast<std::size_t>(i)] == run && past.time_s[static_cast<std::size_t>(i)] <= time_s) {
      mine.push_back(i);
    }
  }
  if (mine.empty()) return 0.0;
  const Rows rows = pick(past, mine);
  const Eigen::VectorXd residual = rows.y - fit.predict(rows.x);
  Eigen::VectorXd k(rows.size());
  for (Eigen::Index i = 0; i < rows.size(); ++i) {
    k(i) = std::exp(-(time_s - rows.time_s[static_cast<std::size_t>(i)]) / fit.noise.memory_s);
  }
  return k.dot(noise_matrix(fit.noise, rows).llt().solve(residual));
}

}  // namespace zerodrift::analysis
