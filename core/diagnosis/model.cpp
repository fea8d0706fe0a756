#include "core/diagnosis/model.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/analysis/nonlinear.h"
#include "core/diagnosis/parallel.h"

namespace zerodrift::diagnosis {

using Eigen::Index;

static bool is_same(const physics::Parameter& a, const physics::Parameter& b) {
  return a.key == b.key && a.component == b.component && a.channel == b.channel && a.effect == b.effect;
}

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
  m_gram.setZero(n, n);
  m_stale.assign(m_free.size(), true);
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
  m_simulated = {};
  m_ready = false;
  std::vector<bool> used(parent.unknowns(), false);
  std::vector<std::pair<Index, Index>> taken;  // columns: mine, the parent's
  for (std::size_t i = 0; i < unknowns(); ++i) {
    for (std::size_t k = 0; k < parent.unknowns(); ++k) {
      if (used[k] || !is_same(unknown(i), parent.unknown(k))) continue;
      used[k] = true;
      m_z[static_cast<Index>(i)] =
          std::clamp(parent.m_z[static_cast<Index>(k)], m_low[static_cast<Index>(i)], m_high[static_cast<Index>(i)]);
      if (columns && parent.m_have_columns) {
        m_stale[i] = parent.m_stale[k];
        taken.emplace_back(i, k);
      }
      break;
    }
  }
  m_borrowed = m_have_columns = columns && parent.m_have_columns;
  if (!m_have_columns) return;
  m_jacobian.setZero(static_cast<Index>(m_data->stacked()), m_z.size());
  for (const auto& [i, k] : taken) {
    m_jacobian.col(i) = parent.m_jacobian.col(k);
    for (const auto& [j, l] : taken) m_gram(i, j) = parent.m_gram(k, l);
  }
}

void Model::set_z(std::size_t i, double z) {
  const Index at = static_cast<Index>(i);
  m_z[at] = std::clamp(z, m_low[at], m_high[at]);
  m_simulated = {};
  m_ready = false;
}

void Model::learn_from(const Model& other, Sensors sensors) {
  constexpr double moved = 0.25;  // of an offset's sigma: how far it moves from one recording to the next
  const Index n = static_cast<Index>(m_free.size());
  std::vector<Index> mine, theirs;
  const auto is_new = [&](const physics::Parameter& p) {
    const bool stays = p.of_sensor && sensors == Sensors::the_same;
    const bool once = p.effect >= 0 && physics::happens_once(m_machine.effects[p.effect].id);
    return once || (p.per_recording && !stays);
  };
  for (std::size_t i = 0; i < unknowns(); ++i) {
    for (std::size_t k = 0; k < other.unknowns(); ++k) {
      if (is_new(unknown(i)) || !is_same(unknown(i), other.unknown(k))) continue;
      mine.push_back(static_cast<Index>(i));
      theirs.push_back(static_cast<Index>(k));
      break;
    }
  }
  const Index known = static_cast<Index>(mine.size());
  const Index all = other.m_z.size();
  const Eigen::MatrixXd covariance = other.hessian().llt().solve(Eigen::MatrixXd::Identity(all, all));
  Eigen::MatrixXd shared = covariance(theirs, theirs);
  for (Index i = 0; i < known; ++i) {
    const Index at = mine[static_cast<std::size_t>(i)];
    if (unknown(static_cast<std::size_t>(at)).of_sensor) shared(i, i) += moved * moved;
  }
  const Eigen::MatrixXd inverse = shared.llt().solve(Eigen::MatrixXd::Identity(known, known));
  m_learned.setIdentity(n, n);
  m_learned(mine, mine) = inverse;
  m_learned_z.setZero(n);
  for (Index i = 0; i < known; ++i) {
    m_learned_z[mine[static_cast<std::size_t>(i)]] = m_z[mine[static_cast<std::size_t>(i)]] =
        other.m_z[theirs[static_cast<std::size_t>(i)]];
  }
  // In the place of the effects' own, which the other recording has paid: the prior's density in more than one unknown.
  m_log_prior = 0.5 * Eigen::LDLT<Eigen::MatrixXd>(inverse).vectorD().array().max(1e-300).log().sum();
  m_simulated = {};
  m_ready = false;
}

double Model::prior_cost(const Eigen::VectorXd& z) const {
  if (m_learned.size() == 0) return z.squaredNorm();
  const Eigen::VectorXd off = z - m_learned_z;
  return off.dot(m_learned * off);
}

double Model::strain() const {
  return prior_cost(m_z) / static_cast<double>(std::max<std::size_t>(1, unknowns()));
}

Eigen::VectorXd Model::prior_slope() const {
  if (m_learned.size() == 0) return m_z;
  return m_learned * (m_z - m_learned_z);
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

physics::Prediction Model::prediction() const {
  if (m_simulated.channels.empty()) return physics::predict(m_network, m_inputs, values());
  physics::Prediction readings{m_simulated.rows, 0, {}};
  for (const auto& channel : m_simulated.channels) {
    readings.channels.push_back({channel.channel, channel.temperature, channel.values, {}});
  }
  return readings;
}

physics::Prediction Model::predict_at(const Eigen::VectorXd& z, const std::vector<int>& unknowns) const {
  std::vector<int> parameters;
  for (const int i : unknowns) parameters.push_back(m_free[i]);
  return predicted(m_network, m_inputs, values_at(z), parameters);
}

void Model::take_columns(const physics::Prediction& prediction, const std::vector<int>& unknowns) {
  if (unknowns.empty()) return;
  // Most models are only simulated: the largest thing that they may have is not there before its first column is.
  if (m_jacobian.size() == 0) {
    m_jacobian.resize(static_cast<Index>(m_data->stacked()), m_z.size());
    if (unknowns.size() < m_free.size()) m_jacobian.setZero();
  }
  const std::vector<double> values = values_at(m_z);
  std::vector<double> slopes;
  for (const int i : unknowns) {
    slopes.push_back(unknown(static_cast<std::size_t>(i)).slope_at(values[m_free[i]]));
    m_stale[i] = true;
  }
  whiten_columns(*m_data, prediction, slopes, m_jacobian, unknowns);
}

/// Keeps what was simulated at m_z, for the same hypothesis under other noise.
void Model::keep(const physics::Prediction& prediction, const std::vector<int>& unknowns) {
  const std::size_t width = m_free.size();
  if (m_simulated.columns != width) return;
  for (std::size_t c = 0; c < prediction.channels.size(); ++c) {
    const physics::PredictedChannel& from = prediction.channels[c];
    physics::PredictedChannel& to = m_simulated.channels[c];
    to.values = from.values;
    for (std::size_t k = 0; k < prediction.rows; ++k) {
      for (std::size_t u = 0; u < unknowns.size(); ++u) {
        to.derivatives[k * width + static_cast<std::size_t>(unknowns[u])] = from.derivatives[k * unknowns.size() + u];
      }
    }
  }
}

void Model::refresh(const std::vector<int>& unknowns) {
  physics::Prediction prediction = predict_at(m_z, unknowns);
  m_log_determinant = whiten(*m_data, prediction, &m_residual);
  take_columns(prediction, unknowns);
  m_cost = m_residual.squaredNorm() + prior_cost(m_z);
  if (unknowns.size() == m_free.size()) {
    m_simulated = std::move(prediction);
  } else {
    keep(prediction, unknowns);
  }
}

void Model::continue_from(const Model& same) {
  if (same.m_simulated.columns != m_free.size() || m_free.empty()) return start_from(same, false);
  m_z = same.m_z;
  m_simulated = same.m_simulated;
  m_borrowed = same.m_borrowed;
  m_log_determinant = whiten(*m_data, m_simulated, &m_residual);
  take_columns(m_simulated, all_unknowns());
  m_cost = m_residual.squaredNorm() + prior_cost(m_z);
  m_have_columns = m_ready = true;
}

Eigen::MatrixXd Model::hessian() const {
  const Index n = static_cast<Index>(m_free.size());
  std::vector<Index> stale;
  for (Index i = 0; i < n; ++i) {
    if (m_stale[static_cast<std::size_t>(i)]) stale.push_back(i);
  }
  const Index changed = static_cast<Index>(stale.size());
  if (2 * changed > n) {
    m_gram.setZero(n, n);
    m_gram.selfadjointView<Eigen::Lower>().rankUpdate(m_jacobian.transpose());
    m_gram = Eigen::MatrixXd(m_gram.selfadjointView<Eigen::Lower>());
  } else if (changed > 0) {
    const Eigen::MatrixXd columns = m_jacobian(Eigen::all, stale);
    const Eigen::MatrixXd products = m_jacobian.transpose() * columns;
    for (Index k = 0; k < changed; ++k) {
      m_gram.col(stale[static_cast<std::size_t>(k)]) = products.col(k);
      m_gram.row(stale[static_cast<std::size_t>(k)]) = products.col(k).transpose();
    }
  }
  m_stale.assign(m_free.size(), false);
  if (m_learned.size() != 0) return m_gram + m_learned;
  return m_gram + Eigen::MatrixXd::Identity(n, n);
}

double Model::promised_by_a_whole_step() const {
  const Eigen::VectorXd slope = m_jacobian.transpose() * m_residual - prior_slope();
  return analysis::damped_step(hessian(), slope, Eigen::VectorXd::Zero(m_z.size()), m_z, m_low, m_high).dot(slope);
}

/// Chord steps: the base's columns change little, so only the effect's are renewed each step, by the simulation that
/// tries the step; all of them after a large gain or three steps. Where a fit is to reach the bottom: a valley that
/// bends - an effect that a scale of what is described stands in for - makes a whole step fail, and more damping crawls
/// along it. What the step left beside its linear promise is taken back first (Transtrum & Sethna 2012,
/// arXiv:1201.5885, the second-order step, here from the trial that failed).
void Model::fit(const FitOptions& options) {
  m_log_evidence.reset();
  const std::vector<int> all = all_unknowns();
  const std::vector<int> effects = effect_unknowns();
  int stale = m_borrowed ? 1 : 0;
  if (!m_ready) refresh(m_borrowed ? effects : all);
  m_ready = m_borrowed = false;
  m_have_columns = true;
  analysis::Damping damping;
  physics::Prediction trial;
  Eigen::VectorXd trial_residual;
  constexpr double slow = 0.5;  // of the cost, with columns that are old
  const analysis::Damping undamped(1e-6, 1e-6, 1e-3);
  constexpr double bend = 1.0;  // a correction is small, or the step was too long
  const auto simulated = [&](const Eigen::VectorXd& z, const std::vector<int>& columns) {
    trial = predict_at(z, columns);
    m_log_determinant = whiten(*m_data, trial, &trial_residual);
    return trial_residual.squaredNorm() + prior_cost(z);
  };
  const auto stopped = [this] { return m_data->stop.stop_requested(); };  // the rest is thrown away
  for (int iteration = 0; iteration < options.iterations && !stopped(); ++iteration) {
    const Eigen::MatrixXd h = hessian();
    const Eigen::VectorXd g = m_jacobian.transpose() * m_residual - prior_slope();
    bool better = false;
    bool promising = true;
    bool fresh_effects = false;
    double gained = 0.0;
    for (int attempt = 0; attempt < 5 && !better && promising; ++attempt) {
      const Eigen::VectorXd held = damping.value() * h.diagonal();
      const Eigen::VectorXd step = analysis::damped_step(h, g, held, m_z, m_low, m_high);
      Eigen::VectorXd z = (m_z + step.cwiseMax(-4.0).cwiseMin(4.0)).cwiseMax(m_low).cwiseMin(m_high);
      // What the quadratic model promises; far less than what counts as converged is not worth a simulation.
      promising = 2.0 * step.dot(g) - step.dot(h * step) > 0.1 * options.tolerance;
      if (!promising) break;
      fresh_effects = attempt == 0;
      double cost = simulated(z, fresh_effects ? effects : std::vector<int>{});
      if (options.to_the_bottom && cost >= m_cost && std::isfinite(cost)) {
        const Eigen::VectorXd bent = m_jacobian.transpose() * (trial_residual - m_residual + m_jacobian * (z - m_z));
        const Eigen::VectorXd back = analysis::damped_step(h, bent, held, z, m_low, m_high);
        z = (z + back.cwiseMax(-bend).cwiseMin(bend)).cwiseMax(m_low).cwiseMin(m_high);
        fresh_effects = false;
        cost = simulated(z, {});
      }
      if (cost < m_cost) {
        gained = m_cost - cost;
        m_z = z;
        m_cost = cost;
        m_residual = trial_residual;
        keep(trial, fresh_effects ? effects : std::vector<int>{});
        damping.helped();
        better = true;
      } else {
        damping.failed();
      }
    }
    if (options.to_the_bottom && better && gained < slow) {
      refresh(all);
      stale = 0;
      if (promised_by_a_whole_step() < options.tolerance) break;
      damping = undamped;
      continue;
    }
    if (!better && stale == 0) break;
    if (better && gained < options.tolerance && stale == 0) break;
    if (!better || gained > 30.0 || stale >= 3 || effects.empty()) {
      refresh(all);
      stale = 0;
      if (!better) damping.restart();
    } else {
      if (fresh_effects) {
        take_columns(trial, effects);
      } else {
        refresh(effects);
      }
      ++stale;
      if (gained < slow) break;
    }
  }
  const bool refreshed = options.final_refresh && !stopped();
  if (stale != 0 && refreshed) refresh(all);
  m_borrowed = stale != 0 && !refreshed;
  m_ready = !m_borrowed;
  log_evidence();  // here, where fits run side by side, and not one by one where they are compared
}

double Model::log_evidence() const {
  if (m_log_evidence) return *m_log_evidence;
  const Eigen::LDLT<Eigen::MatrixXd> factors(hessian());
  m_log_evidence = m_log_prior - 0.5 * m_cost - 0.5 * factors.vectorD().array().max(1e-300).log().sum();
  return *m_log_evidence;
}

double Model::promised() const {
  const Eigen::VectorXd g = m_jacobian.transpose() * m_residual - prior_slope();
  return 0.5 * g.dot(hessian().llt().solve(g));
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

bool Model::is_at_a_bound(std::size_t i) const {
  const Index at = static_cast<Index>(i);
  return unknown(i).effect >= 0 && (m_z[at] <= m_low[at] + 1e-9 || m_z[at] >= m_high[at] - 1e-9);
}

std::vector<std::string> Model::bounds_reached() const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < unknowns(); ++i) {
    if (is_at_a_bound(i)) names.push_back(unknown(i).key);
  }
  return names;
}

std::string Model::at_its_limit() const {
  for (std::size_t i = 0; i < unknowns(); ++i) {
    if (!is_at_a_bound(i) || !unknown(i).amplitude || value(i) == 0.0) continue;
    const physics::EffectSpec& spec = machine().effects[static_cast<std::size_t>(unknown(i).effect)];
    if (spec.candidate) return spec.id;
  }
  return {};
}

double Model::inputs_late() const {
  const int hold = free_index(network().hold_parameter);
  if (hold < 0) return 0.0;
  const bool after = m_z[hold] >= m_high[hold] - 1e-9;
  if (!after && m_z[hold] > m_low[hold] + 1e-9) return 0.0;
  const Eigen::VectorXd unit = Eigen::VectorXd::Unit(m_z.size(), hold);
  const Eigen::VectorXd covariance = hessian().ldlt().solve(unit);  // with the others
  const double step = covariance.dot(m_jacobian.transpose() * m_residual - prior_slope());
  const double evidence = 0.5 * step * step / covariance[hold];
  if (after) return step > 0.0 ? evidence : 0.0;
  return step < 0.0 ? -evidence : 0.0;
}

std::vector<double> block_excess(const Dataset& data, const Eigen::VectorXd& residual) {
  std::vector<double> excess(data.channels.size(), 0.0);
  if (data.rows() < 8) return excess;
  const double period_s = (data.time_s.back() - data.time_s.front()) / static_cast<double>(data.rows() - 1);
  // Short runs have fewer minutes in a block, so that there are blocks to compare.
  const double block_s = std::min(900.0, 0.1 * (data.time_s.back() - data.time_s.front()));
  const std::size_t block = std::max<std::size_t>(4, static_cast<std::size_t>(std::lround(block_s / period_s)));
  constexpr int fewest = 15;  // one of two blocks is large by chance: those a run is too short for count as usual
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
    const int usual = std::max(0, fewest - blocks);
    if (blocks > 0) excess[c] = (sum + usual) / (blocks + usual);
  }
  return excess;
}

}  // namespace zerodrift::diagnosis
