#pragma once
// Non-linear least squares by Levenberg and Marquardt. The damped step is the one that the search for missing physics
// takes with its own bookkeeping of which derivatives are fresh.

#include <Eigen/Core>
#include <functional>

namespace zerodrift::analysis {

/// How far a step is held back (Marquardt 1963): less after every step that helped, more after one that did not.
class Damping {
 public:
  Damping() = default;
  Damping(double start, double least, double after_failure)
      : m_start(start), m_least(least), m_after_failure(after_failure), m_value(start) {}
  double value() const { return m_value; }
  void helped() { m_value = m_value / 8.0 > m_least ? m_value / 8.0 : m_least; }
  void failed() { m_value = m_value * 8.0 > m_after_failure ? m_value * 8.0 : m_after_failure; }
  void restart() { m_value = m_start; }

 private:
  double m_start = 1e-3;
  double m_least = 1e-6;
  double m_after_failure = 1e-3;  // at least so much: saves trials when each is a simulation
  double m_value = 1e-3;
};

/// Solves (h + diag(held)) step = g, h = J'J and g = -J'r. Where an unknown stands at a bound and g pushes it further
/// it does not move.
Eigen::VectorXd damped_step(const Eigen::MatrixXd& h, const Eigen::VectorXd& g, const Eigen::VectorXd& held,
                            const Eigen::VectorXd& at, const Eigen::VectorXd& low, const Eigen::VectorXd& high);

/// Observed minus predicted at these parameters, and its derivatives when `jacobian` is not null.
using ResidualFunction =
    std::function<void(const Eigen::VectorXd& parameters, Eigen::VectorXd& residual, Eigen::MatrixXd* jacobian)>;

struct NonlinearFit {
  Eigen::VectorXd parameter;
  Eigen::VectorXd standard_error;  // from the curvature at the minimum
  double residual_deviation = 0.0;
  double square_sum = 0.0;
  int iterations = 0;
  bool converged = false;  // false: stopped on the way, or the function had no value
};

/// From `start` downhill to a minimum; then Gauss-Newton steps without damping, solved by an orthogonal factorisation,
/// as long as each is shorter than the one before: the sum of squares alone is flat to about half the digits.
NonlinearFit nonlinear_least_squares(const ResidualFunction& function, const Eigen::VectorXd& start);

}  // namespace zerodrift::analysis
