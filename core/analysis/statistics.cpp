#include "core/analysis/statistics.h"

#include <Eigen/QR>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>

namespace zerodrift::analysis {
namespace {

constexpr double most_steps = 1e7;  // of a grid; times further apart are no recording's

/// Centred columns of unit length; a column that does not move becomes zero.
Eigen::MatrixXd unit_columns(const Eigen::MatrixXd& columns) {
  Eigen::MatrixXd unit = columns.rowwise() - columns.colwise().mean();
  for (Eigen::Index c = 0; c < unit.cols(); ++c) {
    const double length = unit.col(c).norm();
    if (length > 0.0) unit.col(c) /= length;
  }
  return unit;
}

Eigen::VectorXd on_grid(const std::vector<double>& time_s, const Eigen::VectorXd& values, double grid_s) {
  std::vector<double> t;
  std::vector<double> v;
  for (std::size_t i = 0; i < time_s.size(); ++i) {
    const double value = values(static_cast<Eigen::Index>(i));
    if (!std::isfinite(value)) continue;
    t.push_back(time_s[i]);
    v.push_back(value);
  }
  if (t.empty()) return {};
  const double steps = (time_s.back() - time_s.front()) / grid_s;
  if (!(steps >= 0.0 && steps < most_steps)) return {};
  const auto count = static_cast<Eigen::Index>(steps) + 1;
  Eigen::VectorXd out(count);
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double at = time_s.front() + static_cast<double>(i) * grid_s;
    while (k + 1 < t.size() && t[k + 1] < at) ++k;
    if (at <= t.front() || t.size() == 1) {
      out(i) = v.front();
    } else if (k + 1 >= t.size()) {
      out(i) = v.back();
    } else {
      out(i) = v[k] + (at - t[k]) / (t[k + 1] - t[k]) * (v[k + 1] - v[k]);
    }
  }
  return out;
}

}  // namespace

double pearson(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  double sum_a = 0.0;
  double sum_b = 0.0;
  int n = 0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a(i)) || !std::isfinite(b(i))) continue;
    sum_a += a(i);
    sum_b += b(i);
    ++n;
  }
  if (n < 3) return 0.0;
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    if (!std::isfinite(a(i)) || !std::isfinite(b(i))) continue;
    const double da = a(i) - sum_a / n;
    const double db = b(i) - sum_b / n;
    aa += da * da;
    bb += db * db;
    ab += da * db;
  }
  if (aa <= 0.0 || bb <= 0.0) return 0.0;
  return std::clamp(ab / std::sqrt(aa * bb), -1.0, 1.0);
}

double lag_s(const std::vector<double>& time_s, const Eigen::VectorXd& sensor, const Eigen::VectorXd& error,
             double grid_s, double limit_s) {
  const Eigen::VectorXd a = on_grid(time_s, sensor, grid_s);
  const Eigen::VectorXd b = on_grid(time_s, error, grid_s);
  if (a.size() < 8 || b.size() != a.size()) return 0.0;
  const auto limit = std::min(static_cast<Eigen::Index>(limit_s / grid_s), a.size() / 4);
  double best_r = std::abs(pearson(a, b));
  Eigen::Index best = 0;
  for (Eigen::Index shift = 1; shift <= limit; ++shift) {
    const Eigen::Index n = a.size() - shift;
    const double later = std::abs(pearson(a.tail(n), b.head(n)));
    const double earlier = std::abs(pearson(a.head(n), b.tail(n)));
    if (later > best_r + 1e-9) {
      best_r = later;
      best = shift;
    }
    if (earlier > best_r + 1e-9) {
      best_r = earlier;
      best = -shift;
    }
  }
  return static_cast<double>(best) * grid_s;
}

ThinSvd thin_svd(const Eigen::MatrixXd& a) {
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  return {svd.matrixU(), svd.singularValues(), svd.matrixV()};
}

Eigen::VectorXd variance_inflation(const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd unit = unit_columns(columns);
  const ThinSvd svd = thin_svd(unit);
  Eigen::VectorXd vif = Eigen::VectorXd::Zero(columns.cols());
  for (Eigen::Index j = 0; j < columns.cols(); ++j) {
    for (Eigen::Index k = 0; k < svd.s.size(); ++k) {
      const double s = std::max(svd.s(k), 1e-6);
      vif(j) += svd.v(j, k) * svd.v(j, k) / (s * s);
    }
    vif(j) = std::clamp(vif(j), 1.0, 1e12);
  }
  return vif;
}

double condition_number(const Eigen::MatrixXd& columns) {
  if (columns.cols() == 0) return 1.0;
  const Eigen::VectorXd s = thin_svd(unit_columns(columns)).s;
  return std::min(s(0) / std::max(s(s.size() - 1), 1e-300), 1e12);
}

std::vector<int> spread_of(const Eigen::MatrixXd& columns) {
  const Eigen::MatrixXd centred = columns.rowwise() - columns.colwise().mean();
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(centred);
  const auto& indices = qr.colsPermutation().indices();
  return {indices.begin(), indices.end()};
}

PrincipalComponents principal_components(const Eigen::MatrixXd& items) {
  const Eigen::MatrixXd centred = items.rowwise() - items.colwise().mean();
  const ThinSvd svd = thin_svd(centred);
  const Eigen::VectorXd& s = svd.s;
  Eigen::Index count = 0;
  while (count < s.size() && s(count) > 1e-12 * std::max(s(0), 1e-300)) ++count;
  PrincipalComponents out;
  out.scores = Eigen::MatrixXd::Zero(items.rows(), std::max<Eigen::Index>(count, 2));
  out.explained = Eigen::VectorXd::Zero(out.scores.cols());
  const double total = s.squaredNorm();
  for (Eigen::Index k = 0; k < count; ++k) {
    Eigen::VectorXd score = svd.u.col(k) * s(k);
    Eigen::Index largest = 0;
    score.cwiseAbs().maxCoeff(&largest);
    if (score(largest) < 0.0) score = -score;
    out.scores.col(k) = score;
    out.explained(k) = total > 0.0 ? s(k) * s(k) / total : 0.0;
  }
  return out;
}

ResidualFigures residual_figures(const Eigen::VectorXd& error_um, const Eigen::VectorXd& predicted_um) {
  ResidualFigures figures;
  double squares = 0.0;
  double peak_error = 0.0;
  std::vector<double> sizes;
  for (Eigen::Index i = 0; i < error_um.size(); ++i) {
    if (!std::isfinite(error_um(i)) || !std::isfinite(predicted_um(i))) continue;
    const double residual = error_um(i) - predicted_um(i);
    sizes.push_back(std::abs(residual));
    squares += residual * residual;
    figures.peak_um = std::max(figures.peak_um, std::abs(residual));
    peak_error = std::max(peak_error, std::abs(error_um(i)));
    ++figures.count;
  }
  if (figures.count > 0) figures.rms_um = std::sqrt(squares / figures.count);
  figures.p90_um = upper_quantile(std::move(sizes), 0.9);
  if (peak_error > 0.0) figures.removed_percent = 100.0 * (1.0 - figures.peak_um / peak_error);
  return figures;
}

double median(std::vector<double> values) {
  return upper_quantile(std::move(values), 0.5);
}

double upper_quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  const auto n = static_cast<double>(values.size());
  const auto rank = static_cast<std::ptrdiff_t>(std::clamp(std::ceil(share * n), 1.0, n)) - 1;
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<std::size_t>(rank)];
}

}  // namespace zerodrift::analysis
