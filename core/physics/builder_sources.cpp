// The listed heat sources of a machine and their nominal heat.
#include <algorithm>
#include <cmath>

#include "core/physics/builder.h"
#include "core/physics/sources.h"

namespace zerodrift::physics {
namespace {

/// factor * G of values[0], of which share s (values[1]) is inside: times (1 - s)^outside s^inside.
Law contact_law(double factor, int outside, int inside) {
  return [=](const LawPoint& at) {
    const double s = outside + inside > 0 ? at.values[1] : 0.0;
    const double part = std::pow(1.0 - s, outside) * std::pow(s, inside);
    Strength strength;
    strength.value = factor * at.values[0] * part;
    strength.by_parameter[0] = factor * part;
    if (outside + inside == 0) return strength;
    double slope = 0.0;
    if (outside > 0) slope -= outside * std::pow(1.0 - s, outside - 1) * std::pow(s, inside);
    if (inside > 0) slope += inside * std::pow(1.0 - s, outside) * std::pow(s, inside - 1);
    strength.by_parameter[1] = factor * at.values[0] * slope;
    return strength;
  };
}

}  // namespace

/// What flows out of the body, G (T_b - sum of w_i T_i), enters the component as the source's own heat did, w_i in each
/// cell, so that a body without capacity changes nothing. The matrix of that, G v v^T with v = 1 at the body and -w_i
/// in the cells, is the sum of links between each two nodes of weight -v_i v_j: those between cells are negative.
void NetworkBuilder::join_body(const Component& component, const Term& spread, const std::string& source, int share) {
  const Network::Place& at = place(component.id);
  const SourceBody& body = m_bodies.at(source);
  const bool two = at.inner >= 0 && share >= 0;
  const auto cells = static_cast<int>(spread.weights.size());
  const auto node = [&](int cell, bool inside) {
    return spread.first_node + cell + (inside ? at.inner - at.first : 0);
  };
  const auto put = [&](std::vector<Link> links, double factor, int outside, int inside) {
    Term term;
    term.kind = TermKind::link;
    term.law_kind = LawKind::constant;
    term.label = component.id + "/" + source + "_body";
    term.links = std::move(links);
    term.parameters = {body.contact};
    if (two) term.parameters.push_back(share);
    term.law = two ? contact_law(factor, outside, inside) : contact_law(factor, 0, 0);
    add(std::move(term));
  };
  const auto pairs = [&](bool first_inside, bool second_inside) {
    std::vector<Link> links;
    for (int i = 0; i < cells; ++i) {
      for (int j = first_inside == second_inside ? i + 1 : 0; j < cells; ++j) {
        const double weight = spread.weights[i] * spread.weights[j];
        if (weight > 0.0) links.push_back({node(i, first_inside), node(j, second_inside), weight});
      }
    }
    return links;
  };
  for (const bool inside : {false, true}) {
    if (inside && !two) break;
    std::vector<Link> links;
    for (int i = 0; i < cells; ++i) {
      if (spread.weights[i] > 0.0) links.push_back({body.node, node(i, inside), spread.weights[i]});
    }
    put(std::move(links), 1.0, inside ? 0 : 1, inside ? 1 : 0);
    put(pairs(inside, inside), -1.0, inside ? 0 : 2, inside ? 2 : 0);
  }
  if (two) put(pairs(false, true), -1.0, 1, 1);
}

void NetworkBuilder::add_source(const Component& component, const HeatSource& source) {
  if (component.prescribed) return;
  Term term = source_over(component.id, source.from_mm, source.to_mm);
  const auto split = m_heat_share.find(source.id);
  int share = split == m_heat_share.end() ? -1 : split->second;
  if (const auto body = m_bodies.find(source.id); body != m_bodies.end()) {
    join_body(component, term, source.id, share);
    term.first_node = body->second.node;
    term.weights = {1.0};
    share = -1;
  }
  term.label = component.id + "/" + source.id;
  Parameter scale;
  scale.key = "scale:" + source.id;
  scale.component = component.id;
  scale.mean = scale.start = source.scale > 0.0 ? source.scale : 1.0;
  scale.logarithmic = true;
  scale.sigma = source.power_unknown ? std::max(0.5, m_machine.tolerances.heat_source_power)
                                     : m_machine.tolerances.heat_source_power;
  if (source.kind == SourceKind::speed) {
    const double capacity_J_K = component.lump ? component.heat_capacity_J_K.value_or(stand_in_capacity_J_K) : 4000.0;
    for (const auto& law : source.law) {
      Parameter watts;
      watts.key = "watts_" + law + ":" + source.id;
      watts.component = component.id;
      watts.low = 0.0;
      watts.sigma = capacity_J_K * 20.0 / 3600.0;  // 20 K in an hour
      const auto known = source.law_watts.find(law);
      watts.start = known == source.law_watts.end() ? 0.0 : known->second;
      watts.mean = watts.start;
      if (!source.power_unknown)
        watts.sigma = std::max(0.1 * watts.sigma, m_machine.tolerances.heat_source_power * watts.start);
      term.parameters.push_back(add_parameter(watts));
    }
    const double full = source.full_speed_rpm > 0.0 ? source.full_speed_rpm : m_network.full_speed_rpm;
    term.law = speed_law(source.law, held(source.channel), full);
    add_heat(component.id, std::move(term), share);
    return;
  }
  term.parameters = {add_parameter(scale)};
  if (source.kind == SourceKind::motor) {
    term.law = motor_law(source, held_speed());
    if (source.jacket) {
      term.law_kind = LawKind::state;
      for (std::size_t i = 0; i < term.weights.size(); ++i) {
        term.driver.emplace_back(term.first_node + static_cast<int>(i), term.weights[i]);
      }
    }
  } else if (source.kind == SourceKind::bearing) {
    const auto& modifiers = m_modifiers[source.id];
    for (const auto& m : modifiers) {
      term.parameters.push_back(m.parameter);
      if (m.second_parameter >= 0) term.parameters.push_back(m.second_parameter);
    }
    term.law = bearing_law(source, held_speed(), m_network.full_speed_rpm, modifiers);
    if (!modifiers.empty()) {
      // The oil film lies between the two bodies.
      const auto& at = place(component.id);
      const double own = at.inner >= 0 && share >= 0 ? 0.5 : 1.0;
      term.law_kind = LawKind::state;
      for (std::size_t i = 0; i < term.weights.size(); ++i) {
        const int node = term.first_node + static_cast<int>(i);
        term.driver.emplace_back(node, own * term.weights[i]);
        if (own < 1.0) term.driver.emplace_back(node - at.first + at.inner, (1.0 - own) * term.weights[i]);
      }
    }
  } else if (source.kind == SourceKind::input) {
    term.law = input_law(source.watts_per_unit, held(source.channel));
  } else {
    term.law = friction_law(source.friction_N, held(source.channel));
  }
  add_heat(component.id, std::move(term), share);
}

void NetworkBuilder::add_sources() {
  for (const auto& component : m_machine.components) {
    for (const auto& source : component.sources) add_source(component, source);
  }
}

double nominal_heat_W(const HeatSource& source, double input, double full_speed_rpm) {
  const double one = 1.0;
  LawPoint at;
  at.held = &input;
  at.values = &one;
  if (source.kind == SourceKind::motor) {
    HeatSource dry = source;
    dry.jacket.reset();
    return source.scale * motor_law(dry, 0)(at).value;
  }
  if (source.kind == SourceKind::bearing) return source.scale * bearing_law(source, 0, full_speed_rpm, {})(at).value;
  if (source.kind == SourceKind::input) return source.scale * source.watts_per_unit * input;
  if (source.kind == SourceKind::speed) {
    double sum_W = 0.0;
    for (const auto& [law, watts] : source.law_watts) sum_W += watts * speed_term(law, input, full_speed_rpm);
    return sum_W;
  }
  return source.scale * source.friction_N * std::abs(input) / 60000.0;
}

}  // namespace zerodrift::physics
