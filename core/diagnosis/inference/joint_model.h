#pragma once
// A hypothesis over all recordings: one network a recording, and one vector of unknowns for all of them. Each unknown
// is standardised: z = 0 at what is known beforehand, 1 one standard deviation up; its prior is a unit Gaussian.

#include <memory>
#include <string>
#include <vector>

#include "core/diagnosis/inference/evidence.h"
#include "core/diagnosis/inference/hypothesis.h"
#include "core/physics/prediction.h"

namespace zerodrift::diagnosis::inference {

struct Unknown {
  physics::Parameter parameter;
  int run = -1;          // of one recording; -1: of all
  int effect = -1;       // index into the hypothesis' effects; -1: the description's
  std::string identity;  // the same unknown in another hypothesis
};

class JointModel {
 public:
  JointModel(Hypothesis hypothesis, std::shared_ptr<const Evidence> evidence);

  const Hypothesis& hypothesis() const { return m_hypothesis; }
  const Evidence& evidence() const { return *m_evidence; }
  std::shared_ptr<const Evidence> shared_evidence() const { return m_evidence; }
  std::size_t unknowns() const { return m_unknowns.size(); }
  const Unknown& unknown(std::size_t i) const { return m_unknowns[i]; }
  /// Index of the unknown with this identity, -1: none.
  int find(const std::string& identity) const;
  const Eigen::VectorXd& start() const { return m_start; }
  const Eigen::VectorXd& low() const { return m_low; }
  const Eigen::VectorXd& high() const { return m_high; }
  double value(std::size_t i, const Eigen::VectorXd& z) const;
  std::vector<int> effect_unknowns() const;

  const physics::Network& network(std::size_t run) const { return m_runs[run].network; }
  const physics::InputSet& inputs(std::size_t run) const { return m_runs[run].inputs; }
  /// Index of an unknown among the parameters of a run's network; -1: the run has not got it.
  int parameter_of(std::size_t run, std::size_t unknown) const { return m_runs[run].parameter[unknown]; }
  /// Values of the network's parameters.
  std::vector<double> values(std::size_t run, const Eigen::VectorXd& z) const;
  /// What the series show in a run: [series][row]. Derivatives by the `wanted` unknowns (d/dz) go into those columns of
  /// `columns` (series * rows + row); columns of unknowns that the run has not are set to zero.
  std::vector<std::vector<double>> predict(std::size_t run, const Eigen::VectorXd& z, const std::vector<int>& wanted,
                                           RowMatrix* columns) const;

 private:
  struct InRun {
    physics::Network network;
    physics::InputSet inputs;
    std::vector<int> parameter;  // of each unknown, -1: the run has not got it
  };
  void add_run(int run);

  Hypothesis m_hypothesis;
  std::shared_ptr<const Evidence> m_evidence;
  std::vector<InRun> m_runs;
  std::vector<Unknown> m_unknowns;
  Eigen::VectorXd m_start, m_low, m_high;
};

}  // namespace zerodrift::diagnosis::inference
