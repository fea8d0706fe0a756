#include "core/physics/simulator.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "core/physics/skyline.h"

namespace zerodrift::physics {
namespace {

constexpr double gamma_tr = 0.58578643762690495;  // 2 - sqrt(2)
constexpr double c_star = 1.0 / (gamma_tr * (2.0 - gamma_tr));
constexpr double c_old = (1.0 - gamma_tr) * (1.0 - gamma_tr) / (gamma_tr * (2.0 - gamma_tr));

struct TermNow {
  Strength strength;
  double by_hold = 0.0;
  std::vector<double> weights;
  std::vector<double> by_place;
  std::array<double, max_law_parameters> values{};
  std::array<int, max_law_parameters> columns{};  // -1: not differentiated by
  int place_column = -1;
};

struct FlatLink {
  int first;
  int second;
  double conductance;
};

class Stepper {
 public:
  Stepper(const Network& network, const InputSet& inputs, const std::vector<double>& values,
          const std::vector<int>& parameters, const SimulateOptions& options);
  Trajectory run();

 private:
  void prepare_terms();
  void start_state();
  void record(std::size_t row);
  void step(std::size_t row, double from_share, double to_share, double dt_s);
  void evaluate_environments(std::size_t row, double share);
  void evaluate_terms(std::size_t row, double share, double time_s);
  void evaluate(std::size_t index, std::size_t row, bool changed, double time_s);
  void assemble(double alpha);
  void advance_state(double alpha);
  void advance_derivatives(double alpha);
  void conduct(const double* x, double alpha, double* r) const;
  void force(double alpha, bool first_stage);
  void force_term(std::size_t index, double alpha, bool first_stage);
  void force_by(std::size_t index, double factor, bool first_stage, const double* derivative);
  void force_capacity(bool first_stage);
  Skyline empty_matrix();
  double driver_derivative(const Term& term, std::size_t column) const;

  const Network& m_net;
  const InputSet& m_in;
  const std::vector<double>& m_values;
  SimulateOptions m_options;
  std::size_t m_n;
  std::size_t m_p;
  std::vector<int> m_column;  // parameter -> column or -1
  std::vector<TermNow> m_now;
  std::vector<double> m_environment;
  std::vector<std::vector<std::pair<int, double>>> m_environment_by;  // (column, derivative)
  std::vector<int> m_rank;                                            // node -> row of the matrix
  Skyline m_matrix;
  std::vector<FlatLink> m_links;
  std::vector<double> m_film, m_source, m_capacity, m_t, m_before, m_star, m_next, m_r;
  std::vector<double> m_s, m_s_before, m_s_star, m_rs, m_own;
  double m_hold = 0.0;
  int m_hold_column = -1;
  double m_extrapolate = 0.0;
  double m_last_dt = 0.0;
  double m_last_alpha = 0.0;
  bool m_stiffness_changed = true;
  std::size_t m_row_evaluated = static_cast<std::size_t>(-1);
  Trajectory m_out;
};

/// Breadth first through the links from the node with the fewest: neighbours get rows close to each other (Cuthill and
/// McKee 1969), so that a chain beside a chain costs a few chains.
std::vector<int> neighbourly_order(const Network& network) {
  const std::size_t n = network.nodes();
  std::vector<std::vector<int>> linked(n);
  for (const auto& term : network.terms) {
    for (const auto& link : term.links) {
      linked[link.first].push_back(link.second);
      linked[link.second].push_back(link.first);
    }
  }
  for (auto& list : linked) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
  std::vector<int> order;
  std::vector<bool> taken(n, false);
  while (order.size() < n) {
    int start = -1;
    for (std::size_t i = 0; i < n; ++i) {
      if (!taken[i] && (start < 0 || linked[i].size() < linked[start].size())) start = static_cast<int>(i);
    }
    std::size_t next = order.size();
    order.push_back(start);
    taken[start] = true;
    // Two chains side by side begin with the ends of both, so that they go on in turns.
    for (const int other : linked[start]) {
      if (taken[other] || linked[other].size() != linked[start].size()) continue;
      order.push_back(other);
      taken[other] = true;
      break;
    }
    for (; next < order.size(); ++next) {
      for (const int other : linked[order[next]]) {
        if (taken[other]) continue;
        taken[other] = true;
        order.push_back(other);
      }
    }
  }
  return order;
}

Skyline Stepper::empty_matrix() {
  const auto envelope = [&] {
    std::vector<int> first(m_n);
    for (std::size_t i = 0; i < m_n; ++i) first[i] = static_cast<int>(i);
    for (const auto& term : m_net.terms) {
      for (const auto& link : term.links) {
        const auto [low, high] = std::minmax(m_rank[link.first], m_rank[link.second]);
        first[high] = std::min(first[high], low);
      }
    }
    return first;
  };
  m_rank.resize(m_n);
  for (std::size_t i = 0; i < m_n; ++i) m_rank[i] = static_cast<int>(i);
  std::vector<int> first = envelope();
  bool chain = true;
  for (std::size_t i = 0; i < m_n; ++i) chain = chain && static_cast<int>(i) - first[i] <= 1;
  if (chain) return Skyline(std::move(first));
  std::vector<int> order = neighbourly_order(m_net);
  for (std::size_t i = 0; i < m_n; ++i) m_rank[order[i]] = static_cast<int>(i);
  return Skyline(envelope(), std::move(order));
}

Stepper::Stepper(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                 const std::vector<int>& parameters, const SimulateOptions& options)
    : m_net(network),
      m_in(inputs),
      m_values(values),
      m_options(options),
      m_n(network.nodes()),
      m_p(parameters.size()),
      m_column(network.parameters.size(), -1),
      m_matrix(empty_matrix()) {
  for (std::size_t c = 0; c < m_p; ++c) m_column[parameters[c]] = static_cast<int>(c);
  if (network.hold_parameter >= 0) {
    m_hold = values[network.hold_parameter];
    m_hold_column = m_column[network.hold_parameter];
  }
  for (auto* v : {&m_film, &m_source, &m_capacity, &m_t, &m_before, &m_star, &m_next, &m_r}) v->assign(m_n, 0.0);
  for (auto* v : {&m_s, &m_s_before, &m_s_star, &m_rs}) v->assign(m_n * m_p, 0.0);
  m_own.assign(m_p, 0.0);
  m_environment.assign(network.environments.size(), 0.0);
  m_environment_by.resize(network.environments.size());
  prepare_terms();
  start_state();
}

void Stepper::prepare_terms() {
  m_now.resize(m_net.terms.size());
  for (std::size_t i = 0; i < m_now.size(); ++i) {
    const Term& term = m_net.terms[i];
    TermNow& now = m_now[i];
    now.weights = term.weights;
    if (term.place_parameter >= 0) {
      term.reshape(m_values[term.place_parameter], now.weights, now.by_place);
      now.place_column = m_column[term.place_parameter];
    }
    now.columns.fill(-1);
    for (std::size_t k = 0; k < term.parameters.size(); ++k) {
      now.values[k] = m_values[term.parameters[k]];
      now.columns[k] = m_column[term.parameters[k]];
    }
    for (const auto& link : term.links) m_links.push_back({link.first, link.second, 0.0});
  }
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
  for (std::size_t i = 0; i < m_n; ++i) {
    const int p = m_net.capacity_parameter[i];
    m_capacity[i] = m_net.volume[i] * (p >= 0 ? m_values[p] : 1.0);
  }
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

void Stepper::evaluate_environments(std::size_t row, double share) {
  for (std::size_t e = 0; e < m_environment.size(); ++e) {
    const Environment& env = m_net.environments[e];
    const auto blend = [&](const std::vector<std::vector<double>>& series, int index) {
      return (1.0 - share) * series[row][index] + share * series[row + 1][index];
    };
    double value = env.constant_C;
    if (env.series >= 0) value += blend(m_in.linear, env.series);
    m_environment_by[e].clear();
    for (const auto& part : env.parts) {
      const double basis = part.basis >= 0 ? blend(m_in.signals, part.basis) : 1.0;
      value += m_values[part.parameter] * basis;
      if (m_column[part.parameter] >= 0) m_environment_by[e].emplace_back(m_column[part.parameter], basis);
    }
    m_environment[e] = value;
  }
}

void Stepper::evaluate(std::size_t index, std::size_t row, bool changed, double time_s) {
  const Term& term = m_net.terms[index];
  TermNow& now = m_now[index];
  LawPoint at;
  at.held = m_in.held[row].data();
  at.values = now.values.data();
  at.time_s = time_s;
  for (const auto& [node, weight] : term.driver) {
    at.driver_C += weight * (m_t[node] + m_extrapolate * (m_t[node] - m_before[node]));
  }
  if (term.environment >= 0) at.environment_C = m_environment[term.environment];
  const double old = now.strength.value;
  now.strength = term.law(at);
  now.by_hold = 0.0;
  if (changed && term.law_kind != LawKind::constant) {
    // Within this interval the next sample's inputs already act for the share m_hold of the time.
    at.held = m_in.held[row + 1].data();
    const Strength next = term.law(at);
    now.by_hold = next.value - now.strength.value;
    const auto mix = [&](double a, double b) { return a + m_hold * (b - a); };
    now.strength.value = mix(now.strength.value, next.value);
    now.strength.by_driver = mix(now.strength.by_driver, next.by_driver);
    now.strength.by_environment = mix(now.strength.by_environment, next.by_environment);
    for (std::size_t k = 0; k < term.parameters.size(); ++k) {
      now.strength.by_parameter[k] = mix(now.strength.by_parameter[k], next.by_parameter[k]);
    }
  }
  if (term.kind != TermKind::source && now.strength.value != old) m_stiffness_changed = true;
}

void Stepper::evaluate_terms(std::size_t row, double share, double time_s) {
  const bool first = m_row_evaluated == static_cast<std::size_t>(-1);
  const bool new_row = m_row_evaluated != row;
  const bool changed = m_in.held[row] != m_in.held[row + 1];
  const bool was_changed =
      !first && new_row && row > 0 && (m_in.held[row - 1] != m_in.held[row] || m_row_evaluated + 1 != row);
  evaluate_environments(row, share);
  for (std::size_t i = 0; i < m_now.size(); ++i) {
    const LawKind kind = m_net.terms[i].law_kind;
    const bool needed = first || kind == LawKind::state || kind == LawKind::time ||
                        (kind == LawKind::inputs && new_row && (changed || was_changed));
    if (needed) evaluate(i, row, changed, time_s);
  }
  m_row_evaluated = row;
}

void Stepper::assemble(double alpha) {
  std::fill(m_source.begin(), m_source.end(), 0.0);
  if (m_stiffness_changed) std::fill(m_film.begin(), m_film.end(), 0.0);
  std::size_t link = 0;
  for (std::size_t i = 0; i < m_now.size(); ++i) {
    const Term& term = m_net.terms[i];
    const TermNow& now = m_now[i];
    const double u = now.strength.value;
    if (term.kind == TermKind::link) {
      for (const auto& one : term.links) m_links[link++].conductance = u * one.weight;
      continue;
    }
    if (u == 0.0) continue;
    double* source = m_source.data() + term.first_node;
    if (term.kind == TermKind::source) {
      for (std::size_t w = 0; w < now.weights.size(); ++w) source[w] += u * now.weights[w];
      continue;
    }
    const double towards_C = m_environment[term.environment];
    double* film = m_film.data() + term.first_node;
    for (std::size_t w = 0; w < now.weights.size(); ++w) {
      const double conductance = u * now.weights[w];
      if (m_stiffness_changed) film[w] += conductance;
      source[w] += conductance * towards_C;
    }
  }
  if (!m_stiffness_changed && alpha == m_last_alpha) return;
  m_matrix.clear();
  for (std::size_t i = 0; i < m_n; ++i) m_matrix.diagonal(m_rank[i]) = m_capacity[i] + alpha * m_film[i];
  for (const auto& one : m_links) {
    const double g = alpha * one.conductance;
    const auto [low, high] = std::minmax(m_rank[one.first], m_rank[one.second]);
    m_matrix.diagonal(low) += g;
    m_matrix.diagonal(high) += g;
    m_matrix.below(high, low) -= g;
  }
  m_matrix.factor();
  m_stiffness_changed = false;
  m_last_alpha = alpha;
}

void Stepper::conduct(const double* x, double alpha, double* r) const {
  for (const auto& one : m_links) {
    const double flow = alpha * one.conductance * (x[one.second] - x[one.first]);
    r[one.first] += flow;
    r[one.second] -= flow;
  }
}

void Stepper::advance_state(double alpha) {
  for (std::size_t i = 0; i < m_n; ++i) {
    m_r[i] = m_capacity[i] * m_t[i] + alpha * (2.0 * m_source[i] - m_film[i] * m_t[i]);
  }
  conduct(m_t.data(), alpha, m_r.data());
  m_matrix.solve(m_r.data());
  std::swap(m_star, m_r);
  for (std::size_t i = 0; i < m_n; ++i) {
    m_next[i] = m_capacity[i] * (c_star * m_star[i] - c_old * m_t[i]) + alpha * m_source[i];
  }
  m_matrix.solve(m_next.data());
  if (!m_options.keep_balance) return;
  const double trapezoid = c_star * alpha;  // each of the two trapezoid ends; the rest weighs alpha
  for (std::size_t i = 0; i < m_n; ++i) {
    m_out.stored_J += m_capacity[i] * (m_next[i] - m_t[i]);
    m_out.supplied_J += trapezoid * (2.0 * m_source[i] - m_film[i] * (m_t[i] + m_star[i])) +
                        alpha * (m_source[i] - m_film[i] * m_next[i]);
  }
}

/// Adds, for one column or for all (derivative given), what a change of the term's strength forces.
void Stepper::force_by(std::size_t index, double factor, bool first_stage, const double* derivative) {
  const Term& term = m_net.terms[index];
  const TermNow& now = m_now[index];
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
  const double towards_C = term.kind == TermKind::film ? m_environment[term.environment] : 0.0;
  for (std::size_t w = 0; w < now.weights.size(); ++w) {
    if (now.weights[w] == 0.0) continue;
    const int node = term.first_node + static_cast<int>(w);
    const double drive = term.kind == TermKind::source ? sources : sources * towards_C - temperature(node);
    add(node, factor * now.weights[w] * drive);
  }
}

void Stepper::force_term(std::size_t index, double alpha, bool first_stage) {
  const Term& term = m_net.terms[index];
  const TermNow& now = m_now[index];
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
    for (const auto& [column, by] : m_environment_by[term.environment]) {
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
      const double towards_C = term.kind == TermKind::film ? m_environment[term.environment] : 0.0;
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
  for (std::size_t i = 0; i < m_now.size(); ++i) force_term(i, alpha, first_stage);
  force_capacity(first_stage);
}

ZERODRIFT_WIDE void Stepper::advance_derivatives(double alpha) {
  const std::size_t p = m_p;
  for (std::size_t i = 0; i < m_n; ++i) {
    const double own = m_capacity[i] - alpha * m_film[i];
    const double* s = m_s.data() + i * p;
    double* r = m_rs.data() + i * p;
    for (std::size_t c = 0; c < p; ++c) r[c] = own * s[c];
  }
  for (const auto& one : m_links) {
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
  m_matrix.solve(m_rs.data(), p);
  std::swap(m_s_star, m_rs);
  for (std::size_t i = 0; i < m_n; ++i) {
    const double* star = m_s_star.data() + i * p;
    const double* s = m_s.data() + i * p;
    double* r = m_rs.data() + i * p;
    const double a = c_star * m_capacity[i];
    const double b = c_old * m_capacity[i];
    for (std::size_t c = 0; c < p; ++c) r[c] = a * star[c] - b * s[c];
  }
  force(alpha, false);
  m_matrix.solve(m_rs.data(), p);
  std::swap(m_s_before, m_s);
  std::swap(m_s, m_rs);
}

void Stepper::step(std::size_t row, double from_share, double to_share, double dt_s) {
  const double middle = 0.5 * (from_share + to_share);
  const double time_s = m_in.time_s[row] + middle * (m_in.time_s[row + 1] - m_in.time_s[row]);
  m_extrapolate = m_last_dt > 0.0 ? 0.5 * dt_s / m_last_dt : 0.0;
  evaluate_terms(row, middle, time_s);
  const double alpha = 0.5 * gamma_tr * dt_s;
  assemble(alpha);
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
