#include "core/physics/simulator.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/physics/assembly.h"

namespace zerodrift::physics {
namespace {

constexpr double gamma_tr = 0.58578643762690495;  // 2 - sqrt(2)
constexpr double c_star = 1.0 / (gamma_tr * (2.0 - gamma_tr));
constexpr double c_old = (1.0 - gamma_tr) * (1.0 - gamma_tr) / (gamma_tr * (2.0 - gamma_tr));

class Stepper {
 public:
  Stepper(const Network& network, const InputSet& inputs, const std::vector<double>& values,
          const std::vector<int>& parameters, const SimulateOptions& options);
  Trajectory run();

 private:
  void start_state();
  void record(std::size_t row);
  void step(std::size_t row, double from_share, double to_share, double dt_s);
  void advance_state(double alpha);
  void advance_derivatives(double alpha);
  void conduct(const double* x, double alpha, double* r) const;
  void force(double alpha, bool first_stage);
  void force_term(std::size_t index, double alpha, bool first_stage);
  void force_by(std::size_t index, double factor, bool first_stage, const double* derivative);
  void force_capacity(bool first_stage);

  const Network& m_net;
  const InputSet& m_in;
  const std::vector<double>& m_values;
  SimulateOptions m_options;
  std::size_t m_n;
  std::size_t m_p;
  std::vector<int> m_column;  // parameter -> column or -1
  Assembly m_assembly;
  std::vector<double> m_t, m_before, m_star, m_next, m_r;
  std::vector<double> m_s, m_s_before, m_s_star, m_rs, m_own;
  int m_hold_column = -1;
  double m_extrapolate = 0.0;
  double m_last_dt = 0.0;
  Trajectory m_out;
};

std::vector<int> columns_of(const Network& network, const std::vector<int>& parameters) {
  std::vector<int> columns(network.parameters.size(), -1);
  for (std::size_t c = 0; c < parameters.size(); ++c) columns[parameters[c]] = static_cast<int>(c);
  return columns;
}

Stepper::Stepper(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                 const std::vector<int>& parameters, const SimulateOptions& options)
    : m_net(network),
      m_in(inputs),
      m_values(values),
      m_options(options),
      m_n(network.nodes()),
      m_p(parameters.size()),
      m_column(columns_of(network, parameters)),
      m_assembly(network, inputs, values, m_column) {
  if (network.hold_parameter >= 0) m_hold_column = m_column[network.hold_parameter];
  for (auto* v : {&m_t, &m_before, &m_star, &m_next, &m_r}) v->assign(m_n, 0.0);
  for (auto* v : {&m_s, &m_s_before, &m_s_star, &m_rs}) v->assign(m_n * m_p, 0.0);
  m_own.assign(m_p, 0.0);
  start_state();
}

void Stepper::start_state() {
  m_t = m_net.initial_C;
  for (const auto& part : m_net.initial_parts) {
    for (const auto& [node, weight] : part.nodes) {
      m_t[node] += m_values[part.parameter] * weight;
      if (m_column[part.parameter] >= 0) m_s[node * m_p + m_column[part.parameter]] += weight;
    }
  }
  m_before = m_t;
  m_s_before = m_s;
}

void Stepper::record(std::size_t row) {
  const std::size_t count = m_net.probes.size();
  for (std::size_t k = 0; k < count; ++k) {
    double value = 0.0;
    for (const auto& [node, weight] : m_net.probes[k]) value += weight * m_t[node];
    m_out.probes[row * count + k] = value;
    if (m_p == 0) continue;
    double* by = m_out.derivatives.data() + (k * m_out.rows + row) * m_p;
    for (const auto& [node, weight] : m_net.probes[k]) {
      const double* s = m_s.data() + node * m_p;
      for (std::size_t c = 0; c < m_p; ++c) by[c] += weight * s[c];
    }
  }
  if (m_options.keep_field)
    std::copy(m_t.begin(), m_t.end(), m_out.field_C.begin() + static_cast<std::ptrdiff_t>(row * m_n));
}

void Stepper::conduct(const double* x, double alpha, double* r) const {
  for (const auto& one : m_assembly.links()) {
    const double flow = alpha * one.conductance * (x[one.second] - x[one.first]);
    r[one.first] += flow;
    r[one.second] -= flow;
  }
}

void Stepper::advance_state(double alpha) {
  const auto& capacity = m_assembly.capacity();
  const auto& film = m_assembly.film();
  const auto& source = m_assembly.source();
  for (std::size_t i = 0; i < m_n; ++i) {
    m_r[i] = capacity[i] * m_t[i] + alpha * (2.0 * source[i] - film[i] * m_t[i]);
  }
  conduct(m_t.data(), alpha, m_r.data());
  m_assembly.matrix().solve(m_r.data());
  std::swap(m_star, m_r);
  for (std::size_t i = 0; i < m_n; ++i) {
    m_next[i] = capacity[i] * (c_star * m_star[i] - c_old * m_t[i]) + alpha * source[i];
  }
  m_assembly.matrix().solve(m_next.data());
  if (!m_options.keep_balance) return;
  const double trapezoid = c_star * alpha;  // each of the two trapezoid ends; the rest weighs alpha
  for (std::size_t i = 0; i < m_n; ++i) {
    m_out.stored_J += capacity[i] * (m_next[i] - m_t[i]);
    m_out.supplied_J +=
        trapezoid * (2.0 * source[i] - film[i] * (m_t[i] + m_star[i])) + alpha * (source[i] - film[i] * m_next[i]);
  }
}

/// Adds, for one column or for all (derivative given), what a change of the term's strength forces.
void Stepper::force_by(std::size_t index, double factor, bool first_stage, const double* derivative) {
  const Term& term = m_net.terms[index];
  const TermNow& now = m_assembly.now(index);
  const double sources = first_stage ? 2.0 : 1.0;
  const auto temperature = [&](int node) { return first_stage ? m_t[node] + m_star[node] : m_next[node]; };
  const auto add = [&](int node, double amount) {
    double* r = m_rs.data() + node * m_p;
    for (std::size_t c = 0; c < m_p; ++c) r[c] += amount * derivative[c];
  };
  if (term.kind == TermKind::link) {
    for (const auto& one : term.links) {
      const double flow = factor * one.weight * (temperature(one.second) - temperature(one.first));
      add(one.first, flow);
      add(one.second, -flow);
    }
    return;
  }
  const double towards_C = term.kind == TermKind::film ? m_assembly.environment_C(term.environment) : 0.0;
  for (std::size_t w = 0; w < now.weights.size(); ++w) {
    if (now.weights[w] == 0.0) continue;
    const int node = term.first_node + static_cast<int>(w);
    const double drive = term.kind == TermKind::source ? sources : sources * towards_C - temperature(node);
    add(node, factor * now.weights[w] * drive);
  }
}

void Stepper::force_term(std::size_t index, double alpha, bool first_stage) {
  const Term& term = m_net.terms[index];
  const TermNow& now = m_assembly.now(index);
  const Strength& s = now.strength;
  const double sources = first_stage ? 2.0 : 1.0;
  bool any = false;
  // Direct derivatives of the strength, gathered as a sparse row.
  std::array<std::pair<int, double>, max_law_parameters + 4> direct;
  std::size_t count = 0;
  for (std::size_t k = 0; k < term.parameters.size(); ++k) {
    if (now.columns[k] >= 0 && s.by_parameter[k] != 0.0) direct[count++] = {now.columns[k], s.by_parameter[k]};
  }
  if (m_hold_column >= 0 && now.by_hold != 0.0) direct[count++] = {m_hold_column, now.by_hold};
  if (s.by_driver != 0.0) {
    std::fill(m_own.begin(), m_own.end(), 0.0);
    for (const auto& [node, weight] : term.driver) {
      const double* a = m_s.data() + node * m_p;
      const double* b = m_s_before.data() + node * m_p;
      const double wa = s.by_driver * weight * (1.0 + m_extrapolate);
      const double wb = s.by_driver * weight * m_extrapolate;
      for (std::size_t c = 0; c < m_p; ++c) m_own[c] += wa * a[c] - wb * b[c];
    }
    for (std::size_t k = 0; k < count; ++k) m_own[direct[k].first] += direct[k].second;
    any = true;
  }
  if (term.environment >= 0) {
    for (const auto& [column, by] : m_assembly.environment_by(term.environment)) {
      if (s.value != 0.0) {
        for (std::size_t w = 0; w < now.weights.size(); ++w) {
          m_rs[(term.first_node + w) * m_p + column] += alpha * sources * s.value * now.weights[w] * by;
        }
      }
      if (s.by_environment != 0.0) {
        if (any) {
          m_own[column] += s.by_environment * by;
        } else if (count < direct.size()) {
          direct[count++] = {column, s.by_environment * by};
        }
      }
    }
  }
  if (any) {
    force_by(index, alpha, first_stage, m_own.data());
  } else {
    const auto temperature = [&](int node) { return first_stage ? m_t[node] + m_star[node] : m_next[node]; };
    for (std::size_t k = 0; k < count; ++k) {
      const auto [column, by] = direct[k];
      const double factor = alpha * by;
      if (term.kind == TermKind::link) {
        for (const auto& one : term.links) {
          const double flow = factor * one.weight * (temperature(one.second) - temperature(one.first));
          m_rs[one.first * m_p + column] += flow;
          m_rs[one.second * m_p + column] -= flow;
        }
        continue;
      }
      const double towards_C = term.kind == TermKind::film ? m_assembly.environment_C(term.environment) : 0.0;
      for (std::size_t w = 0; w < now.weights.size(); ++w) {
        const int node = term.first_node + static_cast<int>(w);
        const double drive = term.kind == TermKind::source ? sources : sources * towards_C - temperature(node);
        m_rs[node * m_p + column] += factor * now.weights[w] * drive;
      }
    }
  }
  if (now.place_column >= 0 && s.value != 0.0) {
    for (std::size_t w = 0; w < now.by_place.size(); ++w) {
      m_rs[(term.first_node + w) * m_p + now.place_column] += alpha * sources * s.value * now.by_place[w];
    }
  }
}

void Stepper::force_capacity(bool first_stage) {
  for (std::size_t i = 0; i < m_n; ++i) {
    const int p = m_net.capacity_parameter[i];
    if (p < 0 || m_column[p] < 0) continue;
    const double change = first_stage ? m_star[i] - m_t[i] : m_next[i] - c_star * m_star[i] + c_old * m_t[i];
    m_rs[i * m_p + m_column[p]] -= m_net.volume[i] * change;
  }
}

void Stepper::force(double alpha, bool first_stage) {
  for (std::size_t i = 0; i < m_net.terms.size(); ++i) force_term(i, alpha, first_stage);
  force_capacity(first_stage);
}

ZERODRIFT_WIDE void Stepper::advance_derivatives(double alpha) {
  const std::size_t p = m_p;
  const auto& capacity = m_assembly.capacity();
  const auto& film = m_assembly.film();
  for (std::size_t i = 0; i < m_n; ++i) {
    const double own = capacity[i] - alpha * film[i];
    const double* s = m_s.data() + i * p;
    double* r = m_rs.data() + i * p;
    for (std::size_t c = 0; c < p; ++c) r[c] = own * s[c];
  }
  for (const auto& one : m_assembly.links()) {
    if (one.conductance == 0.0) continue;
    const double g = alpha * one.conductance;
    const double* a = m_s.data() + one.first * p;
    const double* b = m_s.data() + one.second * p;
    double* ra = m_rs.data() + one.first * p;
    double* rb = m_rs.data() + one.second * p;
    for (std::size_t c = 0; c < p; ++c) {
      const double flow = g * (b[c] - a[c]);
      ra[c] += flow;
      rb[c] -= flow;
    }
  }
  force(alpha, true);
  m_assembly.matrix().solve(m_rs.data(), p);
  std::swap(m_s_star, m_rs);
  for (std::size_t i = 0; i < m_n; ++i) {
    const double* star = m_s_star.data() + i * p;
    const double* s = m_s.data() + i * p;
    double* r = m_rs.data() + i * p;
    const double a = c_star * capacity[i];
    const double b = c_old * capacity[i];
    for (std::size_t c = 0; c < p; ++c) r[c] = a * star[c] - b * s[c];
  }
  force(alpha, false);
  m_assembly.matrix().solve(m_rs.data(), p);
  std::swap(m_s_before, m_s);
  std::swap(m_s, m_rs);
}

void Stepper::step(std::size_t row, double from_share, double to_share, double dt_s) {
  const double middle = 0.5 * (from_share + to_share);
  const double time_s = m_in.time_s[row] + middle * (m_in.time_s[row + 1] - m_in.time_s[row]);
  m_extrapolate = m_last_dt > 0.0 ? 0.5 * dt_s / m_last_dt : 0.0;
  m_assembly.evaluate(row, middle, time_s, {m_t.data(), m_before.data(), m_extrapolate});
  const double alpha = 0.5 * gamma_tr * dt_s;
  m_assembly.assemble(alpha);
  advance_state(alpha);
  if (m_p > 0) advance_derivatives(alpha);
  std::swap(m_before, m_t);
  std::swap(m_t, m_next);
  m_last_dt = dt_s;
}

Trajectory Stepper::run() {
  const std::size_t rows = m_in.rows();
  m_out.rows = rows;
  m_out.columns = m_p;
  m_out.probes.assign(rows * m_net.probes.size(), 0.0);
  m_out.derivatives.assign(rows * m_net.probes.size() * m_p, 0.0);
  if (m_options.keep_field) m_out.field_C.assign(rows * m_n, 0.0);
  if (rows > 0) record(0);
  for (std::size_t k = 0; k + 1 < rows; ++k) {
    const double interval_s = m_in.time_s[k + 1] - m_in.time_s[k];
    const int steps = std::max(1, static_cast<int>(std::ceil(interval_s / m_options.longest_step_s)));
    for (int q = 0; q < steps; ++q) step(k, double(q) / steps, double(q + 1) / steps, interval_s / steps);
    record(k + 1);
  }
  return std::move(m_out);
}

}  // namespace

Trajectory run_network(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                       const std::vector<int>& parameters, const SimulateOptions& options) {
  return Stepper(network, inputs, values, parameters, options).run();
}

}  // namespace zerodrift::physics
