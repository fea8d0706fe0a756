#include "core/physics/tangent.h"

#include <algorithm>

namespace zerodrift::physics {

Tangent::Tangent(const Network& network, const Assembly& assembly, const std::vector<int>& column, std::size_t columns)
    : m_net(network), m_assembly(assembly), m_n(network.nodes()), m_columns(columns) {
  if (columns == 0) return;
  m_blocks.resize((columns + lanes - 1) / lanes);
  m_s.assign(m_blocks.size() * m_n * lanes, 0.0);
  m_units.resize(network.terms.size());
  for (std::size_t i = 0; i < m_units.size(); ++i) {
    const Term& term = network.terms[i];
    prepare_pushes(i, column);
    if (!term.driver.empty()) m_driven.push_back(i);
    if (term.environment < 0) continue;
    const auto& parts = network.environments[static_cast<std::size_t>(term.environment)].parts;
    if (std::any_of(parts.begin(), parts.end(), [&](const auto& part) { return column[part.parameter] >= 0; })) {
      m_surrounded.push_back(i);
      m_units[i].used = true;
    }
  }
  for (std::size_t i = 0; i < m_units.size(); ++i) {
    if (m_units[i].used || !network.terms[i].driver.empty()) prepare_unit(i);
  }
  for (std::size_t node = 0; node < m_n; ++node) {
    const int parameter = network.capacity_parameter[node];
    if (parameter < 0 || column[parameter] < 0) continue;
    const auto at = static_cast<std::size_t>(column[parameter]);
    m_blocks[at / lanes].capacities.push_back({node, at % lanes});
  }
  for (const auto& part : network.initial_parts) {
    if (column[part.parameter] < 0) continue;
    const auto at = static_cast<std::size_t>(column[part.parameter]);
    double* s = of_block(m_s, at / lanes);
    for (const auto& [node, weight] : part.nodes) s[static_cast<std::size_t>(node) * lanes + at % lanes] += weight;
  }
  m_before = m_r = m_s;
}

void Tangent::prepare_unit(std::size_t term) {
  const Term& of = m_net.terms[term];
  Unit& unit = m_units[term];
  unit.used = true;
  if (of.kind == TermKind::link) {
    for (const auto& link : of.links) {
      unit.nodes.push_back(link.first);
      unit.nodes.push_back(link.second);
    }
    std::sort(unit.nodes.begin(), unit.nodes.end());
    unit.nodes.erase(std::unique(unit.nodes.begin(), unit.nodes.end()), unit.nodes.end());
    const auto index = [&](int node) {
      return static_cast<int>(std::lower_bound(unit.nodes.begin(), unit.nodes.end(), node) - unit.nodes.begin());
    };
    for (const auto& link : of.links) unit.links.emplace_back(index(link.first), index(link.second));
  } else {
    for (std::size_t w = 0; w < m_assembly.now(term).weights.size(); ++w) {
      unit.nodes.push_back(of.first_node + static_cast<int>(w));
    }
  }
  unit.first.assign(unit.nodes.size(), 0.0);
  unit.second = unit.first;
}

void Tangent::prepare_pushes(std::size_t term, const std::vector<int>& column) {
  const Term& of = m_net.terms[term];
  const auto push = [&](int parameter, Slot slot, std::size_t k) {
    if (parameter < 0 || column[parameter] < 0) return;
    const auto at = static_cast<std::size_t>(column[parameter]);
    m_blocks[at / lanes].pushes.push_back({term, slot, k, at % lanes});
    m_units[term].used = true;
  };
  for (std::size_t k = 0; k < of.parameters.size(); ++k) push(of.parameters[k], Slot::parameter, k);
  if (of.law_kind != LawKind::constant) push(m_net.hold_parameter, Slot::hold, 0);
  push(of.place_parameter, Slot::place, 0);
}

ZERODRIFT_WIDE void Tangent::evaluate_unit(std::size_t term, const StepTaken& step) {
  const Term& of = m_net.terms[term];
  const TermNow& now = m_assembly.now(term);
  Unit& unit = m_units[term];
  if (of.kind == TermKind::link) {
    std::fill(unit.first.begin(), unit.first.end(), 0.0);
    std::fill(unit.second.begin(), unit.second.end(), 0.0);
    for (std::size_t k = 0; k < of.links.size(); ++k) {
      const Link& link = of.links[k];
      const auto [a, b] = unit.links[k];
      const double early = step.before_C[link.second] - step.before_C[link.first];
      const double flow = link.weight * (early + step.star_C[link.second] - step.star_C[link.first]);
      const double later = link.weight * (step.after_C[link.second] - step.after_C[link.first]);
      unit.first[a] += flow;
      unit.first[b] -= flow;
      unit.second[a] += later;
      unit.second[b] -= later;
    }
    return;
  }
  const std::size_t count = unit.nodes.size();
  if (of.kind == TermKind::source) {
    for (std::size_t w = 0; w < count; ++w) {
      unit.first[w] = now.weights[w] * 2.0;
      unit.second[w] = now.weights[w];
    }
    return;
  }
  const double towards_C = m_assembly.environment_C(of.environment);
  const double* before_C = step.before_C + of.first_node;
  const double* star_C = step.star_C + of.first_node;
  const double* after_C = step.after_C + of.first_node;
  for (std::size_t w = 0; w < count; ++w) {
    unit.first[w] = now.weights[w] * (2.0 * towards_C - (before_C[w] + star_C[w]));
    unit.second[w] = now.weights[w] * (towards_C - after_C[w]);
  }
}

void Tangent::force(std::size_t block, const StepTaken& step, bool first_stage) {
  const Block& own = m_blocks[block];
  const double sources = first_stage ? 2.0 : 1.0;
  for (const Push& push : own.pushes) {
    const TermNow& now = m_assembly.now(push.term);
    const Unit& unit = m_units[push.term];
    double* r = of_block(m_r, block) + push.lane;
    if (push.slot == Slot::place) {
      const double factor = step.alpha * now.strength.value;
      if (factor == 0.0) continue;
      const Term& of = m_net.terms[push.term];
      const bool film = of.kind == TermKind::film;
      const double towards_C = film ? m_assembly.environment_C(of.environment) : 1.0;
      for (std::size_t w = 0; w < now.by_place.size(); ++w) {
        const auto node = static_cast<std::size_t>(unit.nodes[w]);
        double amount = sources * towards_C;
        if (film) amount -= first_stage ? step.before_C[node] + step.star_C[node] : step.after_C[node];
        r[node * lanes] += factor * now.by_place[w] * amount;
      }
      continue;
    }
    const double by = push.slot == Slot::hold ? now.by_hold : now.strength.by_parameter[push.parameter];
    if (by == 0.0) continue;
    const double factor = step.alpha * by;
    const std::vector<double>& amount = first_stage ? unit.first : unit.second;
    for (std::size_t w = 0; w < amount.size(); ++w) {
      r[static_cast<std::size_t>(unit.nodes[w]) * lanes] += factor * amount[w];
    }
  }
  for (const std::size_t term : m_driven) force_by_driver(block, term, step, first_stage);
  for (const std::size_t term : m_surrounded) force_by_surroundings(block, term, step, first_stage);
  for (const Stored& one : own.capacities) {
    const std::size_t i = one.node;
    const double change = first_stage
                              ? step.star_C[i] - step.before_C[i]
                              : step.after_C[i] - tr_bdf2::c_star * step.star_C[i] + tr_bdf2::c_old * step.before_C[i];
    of_block(m_r, block)[i * lanes + one.lane] -= m_net.volume[i] * change;
  }
}

/// Temperatures move the strength, and every column moves temperatures.
void Tangent::force_by_driver(std::size_t block, std::size_t term, const StepTaken& step, bool first_stage) {
  const double by_driver = m_assembly.now(term).strength.by_driver;
  if (by_driver == 0.0) return;
  const double* s = of_block(m_s, block);
  const double* before = of_block(m_before, block);
  double moved[lanes] = {};
  for (const auto& [node, weight] : m_net.terms[term].driver) {
    const double late = step.alpha * by_driver * weight * (1.0 + step.extrapolate);
    const double early = step.alpha * by_driver * weight * step.extrapolate;
    const std::size_t at = static_cast<std::size_t>(node) * lanes;
    for (std::size_t c = 0; c < lanes; ++c) moved[c] += late * s[at + c] - early * before[at + c];
  }
  const Unit& unit = m_units[term];
  const std::vector<double>& amount = first_stage ? unit.first : unit.second;
  for (std::size_t w = 0; w < amount.size(); ++w) {
    double* r = of_block(m_r, block) + static_cast<std::size_t>(unit.nodes[w]) * lanes;
    for (std::size_t c = 0; c < lanes; ++c) r[c] += amount[w] * moved[c];
  }
}

void Tangent::force_by_surroundings(std::size_t block, std::size_t term, const StepTaken& step, bool first_stage) {
  const TermNow& now = m_assembly.now(term);
  const Unit& unit = m_units[term];
  const std::vector<double>& amount = first_stage ? unit.first : unit.second;
  const double sources = first_stage ? 2.0 : 1.0;
  for (const auto& [column, by] : m_assembly.environment_by(m_net.terms[term].environment)) {
    const auto at = static_cast<std::size_t>(column);
    if (at / lanes != block) continue;
    const double direct = step.alpha * sources * now.strength.value * by;
    const double by_law = step.alpha * now.strength.by_environment * by;
    for (std::size_t w = 0; w < amount.size(); ++w) {
      of_block(m_r, block)[static_cast<std::size_t>(unit.nodes[w]) * lanes + at % lanes] +=
          direct * now.weights[w] + by_law * amount[w];
    }
  }
}

ZERODRIFT_WIDE void Tangent::advance_block(std::size_t block, const StepTaken& step) {
  const double* capacity = m_assembly.capacity().data();
  const Four* s = reinterpret_cast<const Four*>(of_block(m_s, block));
  Four* r = reinterpret_cast<Four*>(of_block(m_r, block));
  for (std::size_t i = 0; i < m_n; ++i) {
    const double twice = 2.0 * capacity[i];
    r[2 * i] = twice * s[2 * i];
    r[2 * i + 1] = twice * s[2 * i + 1];
  }
  force(block, step, true);
  m_assembly.matrix().solve_lanes(of_block(m_r, block));
  for (std::size_t i = 0; i < m_n; ++i) {
    const double a = tr_bdf2::c_star * capacity[i];
    const double b = (tr_bdf2::c_star + tr_bdf2::c_old) * capacity[i];  // the stage is r - s
    r[2 * i] = a * r[2 * i] - b * s[2 * i];
    r[2 * i + 1] = a * r[2 * i + 1] - b * s[2 * i + 1];
  }
  force(block, step, false);
  m_assembly.matrix().solve_lanes(of_block(m_r, block));
}

void Tangent::advance(const StepTaken& step) {
  for (std::size_t i = 0; i < m_units.size(); ++i) {
    if (m_units[i].used) evaluate_unit(i, step);
  }
  for (std::size_t b = 0; b < m_blocks.size(); ++b) advance_block(b, step);
  std::swap(m_before, m_s);
  std::swap(m_s, m_r);
}

/// Two blocks at once: a sum waits for itself at every node, two of them wait together.
ZERODRIFT_WIDE void Tangent::observe(const Probe& probe, double* by) const {
  const std::size_t blocks = m_blocks.size();
  for (std::size_t b = 0; b < blocks; b += 2) {
    const std::size_t other = std::min(b + 1, blocks - 1);
    const Four* one = reinterpret_cast<const Four*>(of_block(m_s, b));
    const Four* two = reinterpret_cast<const Four*>(of_block(m_s, other));
    Four sum[4] = {};
    for (const auto& [node, weight] : probe) {
      const std::ptrdiff_t at = 2 * static_cast<std::ptrdiff_t>(node);
      sum[0] += weight * one[at];
      sum[1] += weight * one[at + 1];
      sum[2] += weight * two[at];
      sum[3] += weight * two[at + 1];
    }
    double* to = by + b * lanes;
    const std::size_t left = m_columns - b * lanes;
    if (left >= 2 * lanes) {
      Four* out = reinterpret_cast<Four*>(to);
      for (std::size_t i = 0; i < 4; ++i) out[i] = sum[i];
    } else {
      for (std::size_t c = 0; c < left; ++c) to[c] = sum[c / 4][c % 4];
    }
  }
}

}  // namespace zerodrift::physics
