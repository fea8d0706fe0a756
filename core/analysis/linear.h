#pragma once
// The linear algebra of regression, one error at a time.
//
// least_squares: textbook least squares (Householder QR with column pivoting, in extended precision, so that badly
// scaled columns keep their digits).
//
// fit_ridge: generalised ridge. The error is intercept + features * coefficients + slow noise, where the noise is
// white or remembers: covariance sigma^2 (exp(-|dt| / memory) + nugget * delta), separate runs independent. Penalty and
// noise model are those of the largest restricted likelihood (Patterson and Thompson 1971; the ridge penalty as the
// prior variance of the coefficients): nothing is split off for choosing them, so a run of one cycle can be used too.
// A noise model that calls more of the residual white than neighbouring measurements scatter is left out.

#include <Eigen/Core>
#include <vector>

namespace zerodrift::analysis {

struct LeastSquares {
  Eigen::VectorXd coefficient;     // of each column of x
  Eigen::VectorXd standard_error;  // of each
  double residual_deviation = 0.0;
  double r_squared = 0.0;  // about the mean when `about_mean`, else about zero
  int rank = 0;
};
LeastSquares least_squares(const Eigen::MatrixXd& x, const Eigen::VectorXd& y, bool about_mean = true);

struct NoiseModel {
  double memory_s = 0.0;  // 0: white
  double nugget = 0.0;    // white part relative to the remembering part
};

/// Rows of one regression: features, error, when and in which run.
struct Rows {
  Eigen::MatrixXd x;
  Eigen::VectorXd y;
  std::vector<double> time_s;
  std::vector<int> run;

  Eigen::Index size() const { return y.size(); }
};
Rows pick(const Rows& rows, const std::vector<int>& which);

/// Variance that white noise can have at most, from second differences of neighbouring rows (6 times its variance for
/// white noise alone; a smooth error adds little). Robust against steps.
double white_variance(const Rows& rows, const Eigen::VectorXd& y);
/// Deviation of each centred feature; one that never moved counts as immense, since it says nothing about states where
/// it does.
Eigen::VectorXd feature_scale(const Eigen::MatrixXd& centred);

struct RidgeChoice {
  std::vector<NoiseModel> noises;
  std::vector<double> penalties;
};
/// White, and memories of 0.5 to 8 h as far as they fit three times into the run; penalties 1e-4 .. 1e4 in half
/// decades.
RidgeChoice default_choice(double duration_s);

struct RidgeFit {
  Eigen::VectorXd mean;  // of the features in training
  Eigen::VectorXd scale;
  Eigen::VectorXd beta;    // of the standardised features, um
  double intercept = 0.0;  // at the mean features, um
  double penalty = 0.0;
  NoiseModel noise;
  double sigma_um = 0.0;       // deviation of the noise
  Eigen::MatrixXd covariance;  // of beta, in units of sigma^2
  double likelihood = 0.0;     // restricted, log, up to a constant

  Eigen::VectorXd predict(const Eigen::MatrixXd& x) const;
  /// Coefficients of the raw features; intercept of the raw features.
  Eigen::VectorXd raw_coefficients() const { return beta.cwiseQuotient(scale); }
  double raw_intercept() const { return intercept - raw_coefficients().dot(mean); }
  /// Standard deviation of error - prediction at each row: noise and uncertain coefficients.
  Eigen::VectorXd deviation(const Eigen::MatrixXd& x) const;
};
RidgeFit fit_ridge(const Rows& rows, const RidgeChoice& choice);
/// Several errors measured in the same rows, one column each (rows.y is not looked at): the costly part is shared.
std::vector<RidgeFit> fit_ridge(const Rows& rows, const Eigen::MatrixXd& errors_um, const RidgeChoice& choice);

/// The fit for a controller that multiplies noisy readings with the coefficients: of all coefficients those with the
/// least expected error, (b - c)' S (b - c) + c' D c, with S the second moments of the features in `x` (smoothed) and D
/// the variances of their readings. So c = (S + D)^-1 S b: what only the difference of two noisy readings says is given
/// up, what they agree on stays. `noise`: deviation of each raw feature's reading. What is given up joins `covariance`.
RidgeFit for_noisy_readings(const RidgeFit& fit, const Eigen::MatrixXd& x, const Eigen::VectorXd& noise);

/// What the slow noise still holds at time_s of a run, given residuals of earlier rows of the same run (best linear
/// prediction). It fades as exp(-(t - time_s) / memory).
double remembered_um(const RidgeFit& fit, const Rows& past, double time_s, int run);

}  // namespace zerodrift::analysis
