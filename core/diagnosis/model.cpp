#include "core/diagnosis/model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/analysis/nonlinear.h"

namespace zerodrift::diagnosis {

using Eigen::Index;

Model::Model(physics::Machine machine, std::shared_ptr<const Dataset> data, bool own_start_only)
    : m_machine(std::move(machine)), m_data(std::move(data)) {
  m_network = physics::build_network(m_machine, *m_data->recording);
  m_inputs = physics::make_inputs(m_network, *m_data->recording);
  for (std::size_t p = 0; p < m_network.parameters.size(); ++p) {
    const physics::Parameter& parameter = m_network.parameters[p];
    const bool fixed = own_start_only && !parameter.per_recording;
    if (parameter.sigma > 0.0 && !fixed) m_free.push_back(static_cast<int>(p));
  }
  const Index n = static_cast<Index>(m_free.size());
  m_z.setZero(n);
  m_low.setConstant(n, -40.0);
  m_high.setConstant(n, 40.0);
  for (Index i = 0; i < n; ++i) {
    const physics::Parameter& p = unknown(static_cast<std::size_t>(i));
    if (p.logarithmic) {
      if (p.low > 0.0) m_low[i] = std::max(-40.0, p.z_of(p.low));
      if (p.high < 1e299) m_high[i] = std::min(40.0, p.z_of(p.high));
      m_z[i] = p.start > 0.0 ? p.z_of(p.start) : 0.0;
    } else {
      if (p.low > -1e299) m_low[i] = p.z_of(p.low);
      if (p.high < 1e299) m_high[i] = p.z_of(p.high);
      // The hold share and end losses start at their means or bounds; everything described starts as described.
      m_z[i] = p.key == "hold" ? 0.0 : p.z_of(p.start);
    }
    m_z[i] = std::clamp(m_z[i], m_low[i], m_high[i]);
  }
  m_jacobian.setZero(static_cast<Index>(m_data->stacked()), n);
  for (const auto& spec : m_machine.effects)
    m_log_prior += spec.candidate ? physics::log_prior_of(spec.id) + spec.log_prior : 0.0;
}

int Model::free_index(int parameter) const {
  const auto at = std::lower_bound(m_free.begin(), m_free.end(), parameter);
  return at != m_free.end() && *at == parameter ? static_cast<int>(at - m_free.begin()) : -1;
}

std::vector<double> Model::values_at(const Eigen::VectorXd& z) const {
  std::vector<double> values = m_network.start_values();
  for (std::size_t i = 0; i < m_free.size(); ++i) values[m_free[i]] = unknown(i).value_of(z[static_cast<Index>(i)]);
  return values;
}

void Model::start_from(const Model& parent, bool columns) {
  const auto same = [](const physics::Parameter& a, const physics::Parameter& b) {
    return a.key == b.key && a.component == b.component && a.channel == b.channel && a.effect == b.effect;
  };
  std::vector<bool> used(parent.unknowns(), false);
  for (std::size_t i = 0; i < unknowns(); ++i) {
    for (std::size_t k = 0; k < parent.unknowns(); ++k) {
      if (used[k] || !same(unknown(i), parent.unknown(k))) continue;
      used[k] = true;
      m_z[static_cast<Index>(i)] =
          std::clamp(parent.m_z[static_cast<Index>(k)], m_low[static_cast<Index>(i)], m_high[static_cast<Index>(i)]);
      if (columns && parent.m_have_columns) {
        m_jacobian.col(static_cast<Index>(i)) = parent.m_jacobian.col(static_cast<Index>(k));
      }
      break;
    }
  }
  m_borrowed = m_have_columns = columns && parent.m_have_columns;
}

void Model::set_z(std::size_t i, double z) {
  const Index at = static_cast<Index>(i);
  m_z[at] = std::clamp(z, m_low[at], m_high[at]);
}

std::vector<int> Model::all_unknowns() const {
  std::vector<int> list(m_free.size());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = static_cast<int>(i);
  return list;
}

std::vector<int> Model::effect_unknowns() const {
  std::vector<int> list;
  for (std::size_t i = 0; i < m_free.size(); ++i) {
    const int effect = unknown(i).effect;
    if (effect >= 0 && m_machine.effects[effect].candidate) list.push_back(static_cast<int>(i));
  }
  return list;
}

void Model::residual_at(const Eigen::VectorXd& z, Eigen::VectorXd& residual) {
  m_log_determinant = whiten(*m_data, predict(m_network, m_inputs, values_at(z)), &residual);
}

void Model::refresh(const std::vector<int>& unknowns) {
  std::vector<int> parameters;
  std::vector<double> slopes;
  const std::vector<double> values = values_at(m_z);
  for (const int i : unknowns) {
    parameters.push_back(m_free[i]);
    slopes.push_back(unknown(static_cast<std::size_t>(i)).slope_at(values[m_free[i]]));
  }
  const physics::Prediction prediction = predict(m_network, m_inputs, values, parameters);
  m_log_determinant = whiten(*m_data, prediction, &m_residual);
  if (!unknowns.empty()) whiten_columns(*m_data, prediction, slopes, m_jacobian, unknowns);
  m_cost = m_residual.squaredNorm() + m_z.squaredNorm();
}

Eigen::MatrixXd Model::hessian() const {
  const Index n = static_cast<Index>(m_free.size());
  Eigen::MatrixXd h = Eigen::MatrixXd::Identity(n, n);
  h.selfadjointView<Eigen::Lower>().rankUpdate(m_jacobian.transpose());
  return h.selfadjointView<Eigen::Lower>();
}

/// Chord steps: the base's columns change little, so only the effect's are renewed each step; all of them after a large
/// gain or three steps.
void Model::fit(const FitOptions& options) {
  m_log_evidence.reset();
  const std::vector<int> all = all_unknowns();
  const std::vector<int> effects = effect_unknowns();
  int stale = m_borrowed ? 1 : 0;
  refresh(m_borrowed ? effects : all);
  m_borrowed = false;
  m_have_columns = true;
  analysis::Damping damping;
  Eigen::VectorXd trial_residual;
  for (int iteration = 0; iteration < options.iterations; ++iteration) {
    const Eigen::MatrixXd h = hessian();
    const Eigen::VectorXd g = m_jacobian.transpose() * m_residual - m_z;
    bool better = false;
    double gained = 0.0;
    for (int attempt = 0; attempt < 5 && !better; ++attempt) {
      const Eigen::VectorXd step =
          analysis::damped_step(h, g, damping.value() * h.diagonal(), m_z, m_low, m_high).cwiseMax(-4.0).cwiseMin(4.0);
      const Eigen::VectorXd z = (m_z + step).cwiseMax(m_low).cwiseMin(m_high);
      residual_at(z, trial_residual);
      const double cost = trial_residual.squaredNorm() + z.squaredNorm();
      if (cost < m_cost) {
        gained = m_cost - cost;
        m_z = z;
        m_cost = cost;
        m_residual = trial_residual;
        damping.helped();
        better = true;
      } else {
        damping.failed();
      }
    }
    if (!better && stale == 0) break;
    if (better && gained < options.tolerance && stale == 0) break;
    if (!better || gained > 30.0 || stale >= 3 || effects.empty()) {
      refresh(all);
      stale = 0;
      if (!better) damping.restart();
    } else {
      refresh(effects);
      ++stale;
      if (gained < 0.5) break;
    }
  }
  if (stale != 0 && options.final_refresh) refresh(all);
  m_borrowed = stale != 0 && !options.final_refresh;
}

double Model::log_evidence() const {
  if (m_log_evidence) return *m_log_evidence;
  const Eigen::LDLT<Eigen::MatrixXd> factors(hessian());
  m_log_evidence = m_log_prior - 0.5 * m_cost - 0.5 * factors.vectorD().array().max(1e-300).log().sum();
  return *m_log_evidence;
}

double Model::log_evidence_total() const {
  return log_evidence() - 0.5 * m_log_determinant;
}

double Model::sigma(std::size_t i) const {
  const Index n = static_cast<Index>(m_free.size());
  Eigen::VectorXd unit = Eigen::VectorXd::Zero(n);
  unit[static_cast<Index>(i)] = 1.0;
  const double variance = hessian().ldlt().solve(unit)[static_cast<Index>(i)];
  return std::sqrt(std::max(0.0, variance)) * std::abs(unknown(i).slope_at(value(i)));
}

std::vector<std::string> Model::bounds_reached() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < unknowns(); ++i) {
    const Index at = static_cast<Index>(i);
    if (unknown(i).effect < 0) continue;
    if (m_z[at] > m_low[at] + 1e-9 && m_z[at] < m_high[at] - 1e-9) continue;
    names.push_back(unknown(i).key);
  }
  return names;
}

std::vector<double> block_excess(const Dataset& data, const Eigen::VectorXd& residual) {
  std::vector<double> excess(data.channels.size(), 0.0);
  if (data.rows() < 8) return excess;
  const double period_s = (data.time_s.back() - data.time_s.front()) / static_cast<double>(data.rows() - 1);
  // Short runs have fewer minutes in a block, so that there are blocks to compare.
  const double block_s = std::min(900.0, 0.1 * (data.time_s.back() - data.time_s.front()));
  const std::size_t block = std::max<std::size_t>(4, static_cast<std::size_t>(std::lround(block_s / period_s)));
  for (std::size_t c = 0; c < data.channels.size(); ++c) {
    double sum = 0.0;
    int blocks = 0;
    for (std::size_t start = 0; start + block <= data.rows(); start += block) {
      double total = 0.0;
      int count = 0;
      for (std::size_t k = start; k < start + block; ++k) {
        total += residual[static_cast<Index>(c * data.rows() + k)];
        count += data.channels[c].present[k] ? 1 : 0;
      }
      if (count == 0) continue;
      sum += total * total / count;
      ++blocks;
    }
    if (blocks > 0) excess[c] = sum / blocks;
  }
  return excess;
}

}  // namespace zerodrift::diagnosis
