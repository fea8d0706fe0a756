#pragma once
// A hypothesis: the machine with some effects added, fitted to one recording with all its parameters free inside their
// priors. Levenberg-Marquardt on the whitened residual and the standardised unknowns (prior rows are identity rows),
// bounds by projection. Its evidence (Laplace) says how much the data prefer it, many parameters or few.

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "core/base/task_context.h"
#include "core/diagnosis/dataset.h"
#include "core/physics/builder.h"

namespace zerodrift::diagnosis {

struct FitOptions {
  int iterations = 12;
  double tolerance = 0.05;  // of the cost, when all columns are fresh
  bool final_refresh = true;
  bool to_the_bottom = false;  // until a whole step promises less than the tolerance, however little one has gained
};

/// Another recording's sensors: those of the first with the offsets they had there, or mounted anew.
enum class Sensors { anew, the_same };

class Model {
 public:
  /// The machine's effects with `candidate` set are the hypothesis.
  /// `own_start_only`: only what is new in each recording (room, start temperatures, offsets) is free.
  Model(physics::Machine machine, std::shared_ptr<const Dataset> data, bool own_start_only = false);

  const physics::Machine& machine() const { return m_machine; }
  const physics::Network& network() const { return m_network; }
  const physics::InputSet& inputs() const { return m_inputs; }
  const Dataset& data() const { return *m_data; }
  std::shared_ptr<const Dataset> shared_data() const { return m_data; }

  std::size_t unknowns() const { return m_free.size(); }
  const physics::Parameter& unknown(std::size_t i) const { return m_network.parameters[m_free[i]]; }
  int free_index(int parameter) const;  // position of a network parameter among the unknowns, -1: fixed
  const Eigen::VectorXd& z() const { return m_z; }
  double value(std::size_t i) const { return unknown(i).value_of(m_z[static_cast<Eigen::Index>(i)]); }
  /// Standard deviation of unknown i in its own unit.
  double sigma(std::size_t i) const;
  std::vector<double> values() const { return values_at(m_z); }
  std::vector<double> values_at(const Eigen::VectorXd& z) const;
  /// Takes over the unknowns that a parent model has too, and its Jacobian columns where `columns` is set.
  void start_from(const Model& parent, bool columns);
  /// Takes over everything from the same hypothesis under other noise: what was simulated there is only whitened anew.
  void continue_from(const Model& same);
  void set_z(std::size_t i, double z);
  /// The same machine in another recording: what its fit there knows about the unknowns that both share, with their
  /// uncertainties, stands in the place of the description. The evidence is then that of this recording beside the
  /// other.
  void learn_from(const Model& other, Sensors sensors = Sensors::anew);

  void fit(const FitOptions& options);

  double cost() const { return m_cost; }
  double log_evidence() const;        // -cost/2 - ln det(J'J + I)/2, and the effects' priors
  double log_evidence_total() const;  // with the noise's own determinant: comparable between noise levels
  double strain() const;              // squares by which unknowns left what was known, in its widths, for each
  double promised() const;            // log evidence that the next step would gain if the model were linear

  const Eigen::VectorXd& residual() const { return m_residual; }
  const RowMatrix& jacobian() const { return m_jacobian; }
  Eigen::MatrixXd hessian() const;                  // J'J and the prior's: I, or what was learned
  physics::Prediction prediction() const;           // at z
  std::vector<std::string> bounds_reached() const;  // of the effects' parameters
  /// The id of a hypothesis that is at the limit of what it can be; empty: none.
  std::string at_its_limit() const;
  /// Log evidence for inputs that act a row or more before the sample that has them (above zero), or after it (below),
  /// where the fit ends at such a bound: columns of two clocks.
  double inputs_late() const;
  double gain = 0.0;       // of the score test that suggested it
  double elsewhere = 0.0;  // log evidence that other recordings add, beside the best without it; 0 where not asked

 private:
  bool is_at_a_bound(std::size_t unknown) const;
  /// The prediction at z with its derivatives by some unknowns.
  physics::Prediction predict_at(const Eigen::VectorXd& z, const std::vector<int>& unknowns) const;
  /// Takes the derivatives of a prediction at m_z over into the Jacobian.
  void take_columns(const physics::Prediction& prediction, const std::vector<int>& unknowns);
  void refresh(const std::vector<int>& unknowns);
  /// By how much a whole step would lower the cost were the model linear.
  double promised_by_a_whole_step() const;
  void keep(const physics::Prediction& prediction, const std::vector<int>& unknowns);
  double prior_cost(const Eigen::VectorXd& z) const;
  Eigen::VectorXd prior_slope() const;
  std::vector<int> all_unknowns() const;
  std::vector<int> effect_unknowns() const;

  physics::Machine m_machine;
  std::shared_ptr<const Dataset> m_data;
  physics::Network m_network;
  physics::InputSet m_inputs;
  std::vector<int> m_free;
  Eigen::VectorXd m_z, m_low, m_high, m_residual;
  RowMatrix m_jacobian;
  mutable Eigen::MatrixXd m_gram;     // J'J, but for
  mutable std::vector<bool> m_stale;  // columns that changed since it was last asked for
  physics::Prediction m_simulated;    // at m_z, with every unknown's column; empty: not simulated
  bool m_borrowed = false;            // some columns come from the parent
  bool m_have_columns = false;
  bool m_ready = false;  // residual is that at m_z, columns are at most a converged step older
  double m_cost = 0.0;
  double m_log_determinant = 0.0;
  double m_log_prior = 0.0;   // of the candidates it has
  Eigen::MatrixXd m_learned;  // inverse covariance of what another recording has shown; or empty
  Eigen::VectorXd m_learned_z;
  mutable std::optional<double> m_log_evidence;  // of today's columns and cost
};

/// Excess of slow variation per channel: mean square of sums of the whitened residual over blocks of 15 minutes; about
/// 1 when nothing is missing.
std::vector<double> block_excess(const Dataset& data, const Eigen::VectorXd& residual);

}  // namespace zerodrift::diagnosis
