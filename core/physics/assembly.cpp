#include "core/physics/assembly.h"

#include <algorithm>
#include <iterator>
#include <numeric>

namespace zerodrift::physics {
namespace {

using Links = std::vector<std::vector<int>>;  // of each node: the others, ascending

Links links_of(const Network& network) {
  Links linked(network.nodes());
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
  return linked;
}

/// Breadth first through the links from the node with the fewest: neighbours get rows close to each other (Cuthill and
/// McKee 1969), so that a chain beside a chain costs a few chains.
std::vector<int> neighbourly_order(const Links& linked) {
  const std::size_t n = linked.size();
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

void unite(std::vector<int>& list, const std::vector<int>& more, int but) {
  std::vector<int> all;
  std::set_union(list.begin(), list.end(), more.begin(), more.end(), std::back_inserter(all));
  all.erase(std::remove(all.begin(), all.end(), but), all.end());
  list = std::move(all);
}

/// The node with the fewest neighbours first, which then are neighbours of each other (minimum degree: Tinney and
/// Walker 1967): a coupling fills in little, wherever along a chain it is.
std::vector<int> order_of_least_degree(Links linked) {
  std::vector<int> order;
  std::vector<bool> taken(linked.size(), false);
  while (order.size() < linked.size()) {
    int least = -1;
    for (std::size_t i = 0; i < linked.size(); ++i) {
      if (!taken[i] && (least < 0 || linked[i].size() < linked[least].size())) least = static_cast<int>(i);
    }
    taken[least] = true;
    order.push_back(least);
    const std::vector<int> around = linked[least];
    for (const int node : around) {
      unite(linked[node], around, node);
      linked[node].erase(std::remove(linked[node].begin(), linked[node].end(), least), linked[node].end());
    }
  }
  return order;
}

/// Adds what elimination makes different from zero: a column hands its other rows on to the first of them.
void fill_in(std::vector<std::vector<int>>& columns) {
  std::vector<std::vector<int>> rows(columns.size());  // of each column, ascending
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (const int column : columns[i]) rows[column].push_back(static_cast<int>(i));
  }
  for (auto& below : rows) {
    if (below.size() > 1) unite(rows[below.front()], {below.begin() + 1, below.end()}, below.front());
  }
  for (auto& row : columns) row.clear();
  for (std::size_t column = 0; column < rows.size(); ++column) {
    for (const int row : rows[column]) columns[row].push_back(static_cast<int>(column));
  }
}

}  // namespace

Skyline Assembly::empty_matrix() {
  const Links links = links_of(m_net);
  const auto ranked = [&](const std::vector<int>& order) {
    m_rank.resize(m_n);
    for (std::size_t i = 0; i < m_n; ++i) m_rank[order[i]] = static_cast<int>(i);
    std::vector<std::vector<int>> columns(m_n);
    for (std::size_t node = 0; node < m_n; ++node) {
      for (const int other : links[node]) {
        if (m_rank[other] < m_rank[node]) columns[m_rank[node]].push_back(m_rank[other]);
      }
    }
    for (auto& row : columns) std::sort(row.begin(), row.end());
    return columns;
  };
  const auto width = [](const std::vector<std::vector<int>>& columns) {
    int widest = 0;
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (!columns[i].empty()) widest = std::max(widest, static_cast<int>(i) - columns[i].front());
    }
    return widest;
  };
  std::vector<int> order(m_n);
  std::iota(order.begin(), order.end(), 0);
  if (auto columns = ranked(order); width(columns) <= 1) return Skyline(columns);
  order = neighbourly_order(links);
  auto columns = ranked(order);
  if (width(columns) > 2) {
    order = order_of_least_degree(links);
    columns = ranked(order);
    fill_in(columns);
  }
  return Skyline(columns, std::move(order));
}

Assembly::Assembly(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                   const std::vector<int>& column)
    : m_net(network),
      m_in(inputs),
      m_values(values),
      m_column(column),
      m_n(network.nodes()),
      m_hold(network.hold_parameter >= 0 ? values[network.hold_parameter] : 0.0),
      m_matrix(empty_matrix()) {
  for (auto* v : {&m_film, &m_source, &m_capacity}) v->assign(m_n, 0.0);
  m_environment.assign(network.environments.size(), 0.0);
  m_environment_by.resize(network.environments.size());
  for (std::size_t i = 0; i < m_n; ++i) {
    const int p = network.capacity_parameter[i];
    m_capacity[i] = network.volume[i] * (p >= 0 ? values[p] : 1.0);
  }
  prepare_terms(values, column);
}

void Assembly::prepare_terms(const std::vector<double>& values, const std::vector<int>& column) {
  m_now.resize(m_net.terms.size());
  for (std::size_t i = 0; i < m_now.size(); ++i) {
    const Term& term = m_net.terms[i];
    TermNow& now = m_now[i];
    now.weights = term.weights;
    if (term.place_parameter >= 0) {
      term.reshape(values[term.place_parameter], now.weights, now.by_place);
      now.place_column = column[term.place_parameter];
    }
    now.columns.fill(-1);
    for (std::size_t k = 0; k < term.parameters.size(); ++k) {
      now.values[k] = values[term.parameters[k]];
      now.columns[k] = column[term.parameters[k]];
    }
    for (const auto& link : term.links) m_links.push_back({link.first, link.second, 0.0});
  }
}

void Assembly::evaluate_environments(std::size_t row, double share) {
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

void Assembly::evaluate_term(std::size_t index, std::size_t row, bool changed, double time_s, const StateView& state) {
  const Term& term = m_net.terms[index];
  TermNow& now = m_now[index];
  LawPoint at;
  at.held = m_in.held[row].data();
  at.values = now.values.data();
  at.time_s = time_s;
  for (const auto& [node, weight] : term.driver) {
    at.driver_C += weight * (state.now_C[node] + state.extrapolate * (state.now_C[node] - state.before_C[node]));
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

void Assembly::evaluate(std::size_t row, double share, double time_s, const StateView& state) {
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
    if (needed) evaluate_term(i, row, changed, time_s, state);
  }
  m_row_evaluated = row;
}

void Assembly::assemble(double alpha) {
  std::fill(m_source.begin(), m_source.end(), 0.0);
  if (m_stiffness_changed) std::fill(m_film.begin(), m_film.end(), 0.0);
  std::size_t link = 0;
  for (std::size_t i = 0; i < m_now.size(); ++i) {
    const Term& term = m_net.terms[i];
    const TermNow& now = m_now[i];
    const double u = now.strength.value;
    if (term.kind == TermKind::link) {
      if (!m_stiffness_changed) continue;
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
  if (m_stiffness_changed || alpha != m_last_alpha) build_matrix(alpha);
}

void Assembly::build_matrix(double alpha) {
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

}  // namespace zerodrift::physics
