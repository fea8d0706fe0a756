#pragma once
// The posterior of one hypothesis. At given sizes of the discrepancy the likelihood is Gaussian: the unknowns are
// fitted by Levenberg and Marquardt on the whitened residual, the gains of the repeatable discrepancy are marginalised
// exactly (they are linear), and the evidence is Laplace's:
//   ln Z = -cost/2 - ln det(J'J + I)/2 - ln det(noise)/2,  cost = |whitened residual|^2 + |z|^2.
// The sizes are chosen by evidence, every one with the unknowns re-optimised in the linear model: alternating sizes and
// fit would lock in where it began, and a wide discrepancy would swallow a weak effect.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "core/diagnosis/inference/joint_model.h"

namespace zerodrift::diagnosis::inference {

/// Of one series in all runs, whitened: J'J, J'r, r'r, and the same with the basis B of the repeatable part.
struct SeriesStatistics {
  Eigen::MatrixXd jj;
  Eigen::VectorXd jr;
  double rr = 0.0;
  Eigen::MatrixXd bj;
  Eigen::VectorXd br;
};

/// The marginal posterior around a point: cost, its gradient's negative half, its curvature's half.
struct Quadratic {
  Eigen::MatrixXd curvature;  // J'J + I, gains marginalised
  Eigen::VectorXd slope;      // J'r - z
  double cost = 0.0;
  double log_determinant = 0.0;  // of the noise, with the repeatable part
};

/// `shown` and `columns` of each run: what the series shows, and its derivatives by the unknowns (rows x unknowns).
SeriesStatistics statistics_of(const Evidence& evidence, std::size_t series, const Sizes& sizes,
                               const std::vector<std::vector<double>>& shown, const std::vector<RowMatrix>& columns);
/// Of all series, in their order; those without samples are not looked at.
Quadratic quadratic_of(const Evidence& evidence, const Sizes& sizes, const Eigen::VectorXd& z,
                       const std::vector<const SeriesStatistics*>& statistics);
/// ln evidence in the linear model, the unknowns re-optimised within low to high; without the prior of the sizes.
double log_evidence_of(const Quadratic& q, const Eigen::VectorXd& z, const Eigen::VectorXd& low,
                       const Eigen::VectorXd& high);

struct FitOptions {
  int iterations = 12;
  bool finish = true;  // with columns that are fresh, as the evidence needs them
};

/// Is there a repeatable part of this group at these sizes?
bool gains_act(const Evidence& evidence, std::size_t group, const Sizes& sizes);
/// Precision of a group's gains given the data alone.
Eigen::LLT<Eigen::MatrixXd> gain_precision(const Evidence& evidence, std::size_t group, const Sizes& sizes);

class Fit {
 public:
  Fit(std::shared_ptr<const JointModel> model, Sizes sizes);

  const JointModel& model() const { return *m_model; }
  std::shared_ptr<const JointModel> shared_model() const { return m_model; }
  const Sizes& sizes() const { return m_sizes; }
  const Eigen::VectorXd& z() const { return m_z; }
  void set_z(std::size_t i, double z);
  /// Everything but the effects as described, and simulated there: what a missing effect has bent is straight again.
  void reset_description();
  /// Takes over the unknowns that another hypothesis has too, and what was simulated there with `columns`.
  void start_from(const Fit& other, bool columns);

  void fit(const FitOptions& options);
  /// Sets the most likely sizes; true when they changed. The unknowns are not yet fitted to them.
  bool choose_sizes();
  void set_sizes(Sizes sizes);
  /// fit() and choose_sizes() until the sizes rest.
  void settle(int rounds = 3);

  double cost() const { return m_cost; }
  double log_evidence() const;  // with the prior of the sizes
  double log_posterior() const { return log_evidence() + m_model->hypothesis().log_prior; }
  Quadratic quadratic() const { return quadratic_at(m_sizes); }
  /// Standard deviation of an unknown in its own unit.
  double sigma(std::size_t i) const;
  double value(std::size_t i) const { return m_model->value(i, m_z); }
  /// [run][series][row]
  const std::vector<std::vector<std::vector<double>>>& predicted() const { return m_predicted; }
  const RowMatrix& columns(std::size_t run) const { return m_columns[run]; }
  /// What the repeatable discrepancy adds to a series, as its mean: [row].
  std::vector<double> repeatable(std::size_t run, std::size_t series) const;
  /// Innovations of a series: white and of unit variance under this hypothesis; 0 where nothing was measured.
  std::vector<double> innovations(std::size_t run, std::size_t series) const;
  /// Of a series at this point.
  const SeriesStatistics& statistics(std::size_t series, const Sizes& sizes) const;
  /// ln evidence of the data at these sizes, the unknowns re-optimised in the linear model.
  double log_evidence_at(const Sizes& sizes) const;

 private:
  using Predicted = std::vector<std::vector<std::vector<double>>>;
  void refresh(const std::vector<int>& unknowns);
  std::vector<int> all_unknowns() const;
  Predicted simulate(const Eigen::VectorXd& z, const std::vector<int>& unknowns, std::vector<RowMatrix>* columns) const;
  double cost_of(const Predicted& predicted, const Eigen::VectorXd& z) const;
  Quadratic quadratic_at(const Sizes& sizes) const;
  std::vector<double> residual(const Predicted& predicted, std::size_t run, std::size_t series) const;
  Eigen::VectorXd gains(std::size_t group) const;

  std::shared_ptr<const JointModel> m_model;
  Sizes m_sizes;
  Eigen::VectorXd m_z;
  Predicted m_predicted;
  std::vector<RowMatrix> m_columns;
  bool m_have_columns = false;
  bool m_stale = true;  // some columns are of another point
  double m_cost = 0.0;
  /// Several threads may ask a fit that none changes.
  struct Guard {
    std::mutex mutex;
    Guard() = default;
    Guard(const Guard&) {}
    Guard& operator=(const Guard&) { return *this; }
  };
  mutable Guard m_guard;
  mutable std::map<std::array<int, 3>, SeriesStatistics> m_statistics;  // at today's point
};

}  // namespace zerodrift::diagnosis::inference
