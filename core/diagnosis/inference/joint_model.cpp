#include "core/diagnosis/inference/joint_model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/diagnosis/inference/parallel.h"
#include "core/physics/builder.h"

namespace zerodrift::diagnosis::inference {
namespace {

constexpr double farthest = 40.0;  // standard deviations: no prior is meant to be left by more

std::string name_of(const HeldEffect& effect) {
  std::string name = effect.spec.id;
  for (const auto& [key, word] : effect.spec.words) name += ":" + key + "=" + word;
  return effect.run < 0 ? name : fmt::format("{}@{}", name, effect.run);
}

/// A number that is misstated is as good as unknown.
void give_up_tolerances(physics::Network& network, const Hypothesis& hypothesis) {
  for (const DescriptionError& error : hypothesis.errors) {
    for (physics::Parameter& parameter : network.parameters) {
      const bool described = hypothesis.effect_of(0, parameter.effect) < 0;
      if (!described || !is_about(error, parameter)) continue;
      parameter.sigma = error.spread;
      parameter.start = parameter.mean * error.value;
    }
  }
}

}  // namespace

JointModel::JointModel(Hypothesis hypothesis, std::shared_ptr<const Evidence> evidence)
    : m_hypothesis(std::move(hypothesis)), m_evidence(std::move(evidence)) {
  for (std::size_t r = 0; r < m_evidence->runs().size(); ++r) add_run(static_cast<int>(r));
  const auto n = static_cast<Eigen::Index>(m_unknowns.size());
  for (InRun& run : m_runs) run.parameter.resize(m_unknowns.size(), -1);
  m_start.setZero(n);
  m_low.setConstant(n, -farthest);
  m_high.setConstant(n, farthest);
  for (Eigen::Index i = 0; i < n; ++i) {
    const physics::Parameter& p = m_unknowns[static_cast<std::size_t>(i)].parameter;
    if (p.low > (p.logarithmic ? 0.0 : -1e299)) m_low[i] = std::max(-farthest, p.z_of(p.low));
    if (p.high < 1e299) m_high[i] = std::min(farthest, p.z_of(p.high));
    // The share of an interval that already has the next inputs starts at its mean; what is described, as described.
    const bool at_mean = p.key == "hold" || (p.logarithmic && !(p.start > 0.0));
    m_start[i] = std::clamp(at_mean ? 0.0 : p.z_of(p.start), m_low[i], m_high[i]);
  }
}

void JointModel::add_run(int run) {
  InRun in;
  const recording::Recording recording =
      set_right(m_evidence->runs()[static_cast<std::size_t>(run)].recording, m_hypothesis.errors);
  in.network = physics::build_network(m_hypothesis.machine_in(run), recording);
  give_up_tolerances(in.network, m_hypothesis);
  in.inputs = physics::make_inputs(in.network, recording);
  in.parameter.assign(m_unknowns.size(), -1);
  std::map<std::string, int> seen;
  for (std::size_t p = 0; p < in.network.parameters.size(); ++p) {
    const physics::Parameter& parameter = in.network.parameters[p];
    if (!(parameter.sigma > 0.0)) continue;
    Unknown unknown{parameter, -1, m_hypothesis.effect_of(run, parameter.effect), {}};
    const bool once = unknown.effect >= 0 && m_hypothesis.effects[static_cast<std::size_t>(unknown.effect)].run >= 0;
    if (parameter.per_recording || once) unknown.run = run;
    unknown.identity =
        fmt::format("{}|{}|{}|{}|{}", parameter.key, parameter.component, parameter.channel,
                    unknown.effect < 0 ? fmt::format("{}", parameter.effect)
                                       : name_of(m_hypothesis.effects[static_cast<std::size_t>(unknown.effect)]),
                    unknown.run);
    unknown.identity += fmt::format("#{}", seen[unknown.identity]++);
    int at = find(unknown.identity);
    if (at < 0) {
      at = static_cast<int>(m_unknowns.size());
      m_unknowns.push_back(std::move(unknown));
      in.parameter.push_back(-1);
    }
    in.parameter[static_cast<std::size_t>(at)] = static_cast<int>(p);
  }
  m_runs.push_back(std::move(in));
}

int JointModel::find(const std::string& identity) const {
  for (std::size_t i = 0; i < m_unknowns.size(); ++i) {
    if (m_unknowns[i].identity == identity) return static_cast<int>(i);
  }
  return -1;
}

double JointModel::value(std::size_t i, const Eigen::VectorXd& z) const {
  return m_unknowns[i].parameter.value_of(z[static_cast<Eigen::Index>(i)]);
}

std::vector<int> JointModel::effect_unknowns() const {
  std::vector<int> list;
  for (std::size_t i = 0; i < m_unknowns.size(); ++i) {
    if (m_unknowns[i].effect >= 0) list.push_back(static_cast<int>(i));
  }
  return list;
}

std::vector<double> JointModel::values(std::size_t run, const Eigen::VectorXd& z) const {
  const InRun& in = m_runs[run];
  std::vector<double> values = in.network.start_values();
  for (std::size_t i = 0; i < m_unknowns.size(); ++i) {
    if (in.parameter[i] < 0) continue;
    // The run's own parameter: what is known of a start or an offset differs from run to run.
    const physics::Parameter& own = in.network.parameters[static_cast<std::size_t>(in.parameter[i])];
    values[static_cast<std::size_t>(in.parameter[i])] =
        (m_unknowns[i].run < 0 ? m_unknowns[i].parameter : own).value_of(z[static_cast<Eigen::Index>(i)]);
  }
  return values;
}

std::vector<std::vector<double>> JointModel::predict(std::size_t run, const Eigen::VectorXd& z,
                                                     const std::vector<int>& wanted, RowMatrix* columns) const {
  const InRun& in = m_runs[run];
  const std::vector<double> values_now = values(run, z);
  std::vector<int> parameters, unknowns;
  std::vector<double> slopes;
  for (const int u : wanted) {
    const int parameter = in.parameter[static_cast<std::size_t>(u)];
    if (parameter < 0) continue;
    parameters.push_back(parameter);
    unknowns.push_back(u);
    slopes.push_back(
        m_unknowns[static_cast<std::size_t>(u)].parameter.slope_at(values_now[static_cast<std::size_t>(parameter)]));
  }
  physics::Prediction prediction = predicted(in.network, in.inputs, values_now, parameters);
  const std::size_t rows = prediction.rows;
  if (columns != nullptr) {
    for (const int u : wanted) {
      if (in.parameter[static_cast<std::size_t>(u)] < 0) columns->col(u).setZero();
    }
    for (std::size_t c = 0; c < prediction.channels.size(); ++c) {
      for (std::size_t k = 0; k < rows; ++k) {
        const double* from = prediction.channels[c].derivatives.data() + k * parameters.size();
        double* to = columns->row(static_cast<Eigen::Index>(c * rows + k)).data();
        for (std::size_t p = 0; p < parameters.size(); ++p) to[unknowns[p]] = slopes[p] * from[p];
      }
    }
  }
  std::vector<std::vector<double>> shown;
  for (auto& channel : prediction.channels) shown.push_back(std::move(channel.values));
  return shown;
}

}  // namespace zerodrift::diagnosis::inference
