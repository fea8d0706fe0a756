#pragma once
// The plain statistics of this room: correlation, lag, collinearity, principal components, figures of a residual.
// Missing values (NaN) are left out in pairs; no function returns NaN.

#include <Eigen/Core>
#include <vector>

namespace zerodrift::analysis {

/// Pearson's r over the rows where both are there; 0 when either does not move or fewer than 3 pairs exist.
double pearson(const Eigen::VectorXd& a, const Eigen::VectorXd& b);

/// Shift in s at which |r| is largest, within +-limit_s: positive when `sensor` follows later than `error`.
/// Both are taken on an even grid of grid_s by straight lines between the samples that are there.
double lag_s(const std::vector<double>& time_s, const Eigen::VectorXd& sensor, const Eigen::VectorXd& error,
             double grid_s, double limit_s);

/// Variance inflation factor of each column (Marquardt 1970): 1 / (1 - R^2) against all the others; at most 1e12.
Eigen::VectorXd variance_inflation(const Eigen::MatrixXd& columns);
/// Ratio of the largest to the smallest singular value of the centred columns, each scaled to unit length; at most
/// 1e12.
double condition_number(const Eigen::MatrixXd& columns);

/// Columns in the order in which each says most that those before it do not: QR with column pivoting (Businger and
/// Golub 1965) of the centred columns, not scaled, so that what hardly moves comes last.
std::vector<int> spread_of(const Eigen::MatrixXd& columns);

/// a = u diag(s) v', s descending, u and v with as many columns as s (one instance of Eigen's slow-to-compile
/// template).
struct ThinSvd {
  Eigen::MatrixXd u;
  Eigen::VectorXd s;
  Eigen::MatrixXd v;
};
ThinSvd thin_svd(const Eigen::MatrixXd& a);

struct PrincipalComponents {
  Eigen::MatrixXd scores;     // items x components: coordinates of each row
  Eigen::VectorXd explained;  // share of the variance of each, descending
};
/// Of the rows of `items`, after the mean row is taken away; every component that carries variance, at least two.
/// The sign is fixed: the largest score of each component is positive.
PrincipalComponents principal_components(const Eigen::MatrixXd& items);

struct ResidualFigures {
  double rms_um = 0.0;
  double peak_um = 0.0;          // largest absolute value
  double p90_um = 0.0;           // nine in ten absolute values are no larger; not a number in older files
  double removed_percent = 0.0;  // of the largest absolute error, 100 (1 - peak residual / peak error)
  int count = 0;
};
/// Over the rows where `error` is there; residual = error - predicted.
ResidualFigures residual_figures(const Eigen::VectorXd& error_um, const Eigen::VectorXd& predicted_um);

double median(std::vector<double> values);
/// Value below which `share` (0..1) of the values lie: the ceil(share * n)-th smallest (conformal, never too small).
double upper_quantile(std::vector<double> values, double share);

}  // namespace zerodrift::analysis
