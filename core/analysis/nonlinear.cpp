#include "core/analysis/nonlinear.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <cmath>
#include <limits>

namespace zerodrift::analysis {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Descent {
  Eigen::VectorXd parameter;
  int iterations = 0;
  bool arrived = false;
};

/// Columns of unit length, so that parameters of any size are alike to the damping and to rounding.
Eigen::VectorXd column_scale(const Eigen::MatrixXd& jacobian) {
  Eigen::VectorXd scale = jacobian.colwise().norm().transpose();
  for (double& s : scale) {
    if (!(s > 0.0)) s = 1.0;
  }
  return scale;
}

Descent descend(const ResidualFunction& function, const Eigen::VectorXd& start) {
  constexpr int most_iterations = 2000;
  constexpr int most_attempts = 60;
  constexpr double flat = 1e-14;  // of the sum of squares
  const Eigen::VectorXd low = Eigen::VectorXd::Constant(start.size(), -unbounded);
  const Eigen::VectorXd high = Eigen::VectorXd::Constant(start.size(), unbounded);
  Descent out{start};
  Eigen::VectorXd residual;
  Eigen::VectorXd trial_residual;
  Eigen::MatrixXd jacobian;
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(start.size());
  Damping damping(1.0, 1e-16, 0.0);
  int flat_steps = 0;
  for (; out.iterations < most_iterations; ++out.iterations) {
    function(out.parameter, residual, &jacobian);
    const double cost = residual.squaredNorm();
    if (!std::isfinite(cost) || !jacobian.allFinite()) return out;
    // The largest seen so far (More 1978): a parameter that has lost its influence must not run away.
    scale = scale.cwiseMax(column_scale(jacobian));
    const Eigen::MatrixXd j = jacobian * scale.cwiseInverse().asDiagonal();
    const Eigen::MatrixXd h = j.transpose() * j;
    const Eigen::VectorXd g = -(j.transpose() * residual);
    double gained = -1.0;
    for (int attempt = 0; attempt < most_attempts && gained < 0.0; ++attempt) {
      const Eigen::VectorXd held = Eigen::VectorXd::Constant(g.size(), damping.value());
      const Eigen::VectorXd step = damped_step(h, g, held, out.parameter, low, high).cwiseQuotient(scale);
      function(out.parameter + step, trial_residual, nullptr);
      const double trial = trial_residual.squaredNorm();
      if (std::isfinite(trial) && trial < cost) {
        gained = cost - trial;
        out.parameter += step;
        damping.helped();
      } else {
        damping.failed();
      }
    }
    // Nothing helps, or only within rounding: the bottom.
    flat_steps = gained > flat * cost ? 0 : flat_steps + 1;
    if (gained < 0.0 || flat_steps >= 3) {
      out.arrived = true;
      return out;
    }
  }
  return out;
}

/// In extended precision: what limits the digits is then the function itself.
Eigen::VectorXd full_step(const Eigen::MatrixXd& jacobian, const Eigen::VectorXd& residual) {
  using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;
  const Eigen::VectorXd scale = column_scale(jacobian);
  const Matrix j = (jacobian * scale.cwiseInverse().asDiagonal()).cast<long double>();
  const Vector step = j.colPivHouseholderQr().solve(Vector(-residual.cast<long double>()));
  return step.cast<double>().cwiseQuotient(scale);
}

/// Keeps what was reached when a step leads uphill by more than rounding: then it was no minimum.
void refine(const ResidualFunction& function, Eigen::VectorXd& parameter) {
  constexpr int most_steps = 100;
  constexpr double rounding = 1e-9;  // of the sum of squares; the step itself must become shorter each time
  Eigen::VectorXd residual;
  Eigen::VectorXd trial_residual;
  Eigen::MatrixXd jacobian;
  double last = unbounded;
  for (int k = 0; k < most_steps; ++k) {
    function(parameter, residual, &jacobian);
    const Eigen::VectorXd step = full_step(jacobian, residual);
    const double size = step.cwiseProduct(column_scale(jacobian)).norm();
    if (!(size < last)) return;
    function(parameter + step, trial_residual, nullptr);
    const bool uphill = !(trial_residual.squaredNorm() <= (1.0 + rounding) * residual.squaredNorm());
    if (uphill) return;
    parameter += step;
    last = size;
  }
}

}  // namespace

Eigen::VectorXd damped_step(const Eigen::MatrixXd& h, const Eigen::VectorXd& g, const Eigen::VectorXd& held,
                            const Eigen::VectorXd& at, const Eigen::VectorXd& low, const Eigen::VectorXd& high) {
  Eigen::MatrixXd damped = h;
  Eigen::VectorXd rhs = g;
  for (Eigen::Index i = 0; i < g.size(); ++i) {
    const bool stuck = (at[i] <= low[i] + 1e-9 && g[i] < 0.0) || (at[i] >= high[i] - 1e-9 && g[i] > 0.0);
    if (stuck) {
      damped.row(i).setZero();
      damped.col(i).setZero();
      rhs[i] = 0.0;
      damped(i, i) = 1.0;
    } else {
      damped(i, i) += held[i];
    }
  }
  return damped.ldlt().solve(rhs);
}

NonlinearFit nonlinear_least_squares(const ResidualFunction& function, const Eigen::VectorXd& start) {
  Descent descent = descend(function, start);
  NonlinearFit fit;
  fit.converged = descent.arrived;
  if (descent.arrived) refine(function, descent.parameter);
  fit.parameter = descent.parameter;
  fit.iterations = descent.iterations;
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;
  function(fit.parameter, residual, &jacobian);
  fit.square_sum = residual.squaredNorm();
  const Eigen::Index freedom = residual.size() - fit.parameter.size();
  fit.residual_deviation = freedom > 0 ? std::sqrt(fit.square_sum / static_cast<double>(freedom)) : 0.0;
  const Eigen::VectorXd scale = column_scale(jacobian);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(jacobian * scale.cwiseInverse().asDiagonal());
  const Eigen::Index n = fit.parameter.size();
  const Eigen::MatrixXd r = qr.matrixQR().topLeftCorner(n, n).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd inverse = r.triangularView<Eigen::Upper>().solve(Eigen::MatrixXd::Identity(n, n));
  fit.standard_error = fit.residual_deviation * inverse.rowwise().norm().cwiseQuotient(scale);
  return fit;
}

}  // namespace zerodrift::analysis
