#include "core/physics/simulator.h"

#include <algorithm>
#include <cmath>

#include "core/physics/tangent.h"

namespace zerodrift::physics {
namespace {

using tr_bdf2::c_old;
using tr_bdf2::c_star;

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

  const Network& m_net;
  const InputSet& m_in;
  const std::vector<double>& m_values;
  SimulateOptions m_options;
  std::size_t m_n;
  std::size_t m_p;
  std::vector<int> m_column;  // parameter -> column or -1
  Assembly m_assembly;
  Tangent m_tangent;
  std::vector<double> m_t, m_before, m_star, m_next;
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
      m_assembly(network, inputs, values, m_column),
      m_tangent(network, m_assembly, m_column, m_p) {
  for (auto* v : {&m_t, &m_before, &m_star, &m_next}) v->assign(m_n, 0.0);
  start_state();
}

void Stepper::start_state() {
  m_t = m_net.initial_C;
  for (const auto& part : m_net.initial_parts) {
    for (const auto& [node, weight] : part.nodes) m_t[node] += m_values[part.parameter] * weight;
  }
  m_before = m_t;
}

void Stepper::record(std::size_t row) {
  const std::size_t count = m_net.probes.size();
  for (std::size_t k = 0; k < count; ++k) {
    double value = 0.0;
    for (const auto& [node, weight] : m_net.probes[k]) value += weight * m_t[node];
    m_out.probes[row * count + k] = value;
    if (m_p == 0 || m_out.derived[k] < 0) continue;
    m_tangent.observe(m_net.probes[k], m_out.derivatives.data() + (m_out.derived[k] * m_out.rows + row) * m_p);
  }
  if (m_options.keep_field)
    std::copy(m_t.begin(), m_t.end(), m_out.field_C.begin() + static_cast<std::ptrdiff_t>(row * m_n));
}

/// The first stage needs no product with the matrix: (C - alpha K) T = 2 C T - A T.
void Stepper::advance_state(double alpha) {
  const auto& capacity = m_assembly.capacity();
  const auto& source = m_assembly.source();
  for (std::size_t i = 0; i < m_n; ++i) m_star[i] = 2.0 * (capacity[i] * m_t[i] + alpha * source[i]);
  m_assembly.matrix().solve(m_star.data());
  for (std::size_t i = 0; i < m_n; ++i) {
    m_star[i] -= m_t[i];
    m_next[i] = capacity[i] * (c_star * m_star[i] - c_old * m_t[i]) + alpha * source[i];
  }
  m_assembly.matrix().solve(m_next.data());
  if (!m_options.keep_balance) return;
  const auto& film = m_assembly.film();
  const double trapezoid = c_star * alpha;  // each of the two trapezoid ends; the rest weighs alpha
  for (std::size_t i = 0; i < m_n; ++i) {
    m_out.stored_J += capacity[i] * (m_next[i] - m_t[i]);
    m_out.supplied_J +=
        trapezoid * (2.0 * source[i] - film[i] * (m_t[i] + m_star[i])) + alpha * (source[i] - film[i] * m_next[i]);
  }
}

void Stepper::step(std::size_t row, double from_share, double to_share, double dt_s) {
  const double middle = 0.5 * (from_share + to_share);
  const double time_s = m_in.time_s[row] + middle * (m_in.time_s[row + 1] - m_in.time_s[row]);
  const double extrapolate = m_last_dt > 0.0 ? 0.5 * dt_s / m_last_dt : 0.0;
  m_assembly.evaluate(row, middle, time_s, {m_t.data(), m_before.data(), extrapolate});
  const double alpha = 0.5 * tr_bdf2::gamma * dt_s;
  m_assembly.assemble(alpha);
  advance_state(alpha);
  if (m_p > 0) m_tangent.advance({m_t.data(), m_star.data(), m_next.data(), alpha, extrapolate});
  std::swap(m_before, m_t);
  std::swap(m_t, m_next);
  m_last_dt = dt_s;
}

Trajectory Stepper::run() {
  const std::size_t rows = m_in.rows();
  m_out.rows = rows;
  m_out.columns = m_p;
  m_out.probes.assign(rows * m_net.probes.size(), 0.0);
  int derived = 0;
  for (std::size_t k = 0; k < m_net.probes.size(); ++k) {
    m_out.derived.push_back(m_options.values_only.empty() || !m_options.values_only[k] ? derived++ : -1);
  }
  m_out.derivatives.resize(rows * static_cast<std::size_t>(derived) * m_p);  // record() writes every row
  if (m_options.keep_field) m_out.field_C.assign(rows * m_n, 0.0);
  if (rows > 0) record(0);
  for (std::size_t k = 0; k + 1 < rows; ++k) {
    const double interval_s = m_in.time_s[k + 1] - m_in.time_s[k];
    // Some time after every step of an input what is left is slow.
    const double longest_s = (m_in.settled[k] ? 2.0 : 1.0) * m_options.longest_step_s;
    const int steps = std::max(1, static_cast<int>(std::ceil(interval_s / longest_s)));
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
