// What every machine has: conduction, capacities, couplings, sensors, displacements.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/physics/effects/laws.h"
#include "core/physics/initial_state.h"
#include "core/physics/unknown_sizes.h"

namespace zerodrift::physics {

/// Two at least within each described source: heat that is spread over more than it reaches is simulated too cold
/// there. A source that is narrower than the rod is thick spreads within the section before it does along it, which no
/// chain of cells shows.
static int cells_of(const Component& rod) {
  constexpr double fewest = 40.0;
  constexpr double most = 200.0;
  constexpr double in_a_source = 2.0;
  constexpr double thick = 0.75;  // of the diameter
  constexpr double rounding = 1e-6;
  double cells = fewest;
  for (const auto& source : rod.sources) {
    const double width_mm = std::max(source.to_mm - source.from_mm, thick * rod.outer_diameter_mm);
    cells = std::max(cells, std::ceil(in_a_source * rod.length_mm / width_mm - rounding));
  }
  return static_cast<int>(std::min(cells, most));
}

/// Of the described section's conduction.
static Strength share_law(const LawPoint& point) {
  Strength s;
  s.value = point.values[0] * point.values[1];
  s.by_parameter[0] = point.values[1];
  s.by_parameter[1] = point.values[0];
  return s;
}

/// A row of cells of this section with conduction along it; the component's conductivity and capacity are there.
void NetworkBuilder::add_cells(const Component& component, int first, int count, double section_m2, const char* label) {
  const double cell_m = component.length_mm * m_per_mm / count;
  const std::vector<int>& shares = m_conduction_shares[component.id];
  const int stretches = std::max(1, static_cast<int>(shares.size()));
  std::vector<Term> conduction(static_cast<std::size_t>(stretches));
  for (int i = 0; i < count; ++i) {
    add_node(component.material.density_kg_m3 * section_m2 * cell_m, m_capacity[component.id],
             reference_C(component.id));
    Term& stretch = conduction[static_cast<std::size_t>(i * stretches / count)];
    if (i > 0) stretch.links.push_back({first + i - 1, first + i, section_m2 / cell_m});
  }
  for (std::size_t i = 0; i < conduction.size(); ++i) {
    conduction[i].kind = TermKind::link;
    conduction[i].law_kind = LawKind::constant;
    conduction[i].label = component.id + label;
    conduction[i].parameters = {m_conductivity[component.id]};
    conduction[i].law = proportional_law;
    if (!shares.empty()) conduction[i].parameters.push_back(shares[i]), conduction[i].law = share_law;
    add(std::move(conduction[i]));
  }
}

int NetworkBuilder::conduction_share(const std::string& component, int face) const {
  const auto shares = m_conduction_shares.find(component);
  if (shares == m_conduction_shares.end() || shares->second.empty()) return -1;
  const auto stretches = static_cast<int>(shares->second.size());
  return shares->second[static_cast<std::size_t>(face * stretches / place(component).count)];
}

void NetworkBuilder::add_rod(const Component& component) {
  Network::Place at;
  at.component = component.id;
  at.first = static_cast<int>(m_network.nodes());
  at.count = m_options.cells > 0 ? m_options.cells : cells_of(component);
  at.cell_m = component.length_mm * m_per_mm / at.count;
  if (component.inner) at.inner_share = component.inner->section_share;
  const Material& m = component.material;
  Parameter k;
  k.key = "conductivity_W_mK";
  k.component = component.id;
  k.mean = k.start = m.conductivity_W_mK;
  k.sigma = m_machine.tolerances.conductivity;
  k.logarithmic = true;
  m_conductivity[component.id] = add_parameter(k);
  Parameter c = k;
  c.key = "heat_capacity_J_kgK";
  c.mean = c.start = m.heat_capacity_J_kgK;
  c.sigma = m_machine.tolerances.heat_capacity;
  m_capacity[component.id] = add_parameter(c);
  for (std::size_t i = 0; i < component.conduction_shares.size(); ++i) {
    Parameter share = k;
    share.key = fmt::format("conduction_share:{}", i);
    share.mean = share.start = component.conduction_shares[i];
    share.sigma = component.conduction_sigma;
    m_conduction_shares[component.id].push_back(add_parameter(share));
  }
  const double section_m2 = (1.0 - at.inner_share) * component.section_m2();
  add_cells(component, at.first, at.count, section_m2, "/conduction");
  if (component.inner) add_inner_body(component, at);
  m_network.places.push_back(at);
}

void NetworkBuilder::add_lump(const Component& component) {
  Network::Place at;
  at.component = component.id;
  at.first = static_cast<int>(m_network.nodes());
  at.count = 1;
  m_network.places.push_back(at);
  if (component.heat_capacity_J_K) {
    Parameter c;
    c.key = "heat_capacity_J_K";
    c.component = component.id;
    c.mean = c.start = *component.heat_capacity_J_K;
    c.sigma = component.capacity_is_guessed ? guess_width : m_machine.tolerances.heat_capacity;
    c.logarithmic = true;
    m_capacity[component.id] = add_parameter(c);
    add_node(1.0, m_capacity[component.id], reference_C(component.id));
  } else {
    add_node(stand_in_capacity_J_K, -1, reference_C(component.id));
    m_network.notes.push_back("capacity_unknown:" + component.id);
  }
}

void NetworkBuilder::add_components() {
  for (const auto& component : m_machine.components) {
    // A prescribed lump is a surrounding, not a node.
    if (component.prescribed) {
      Environment boundary;
      boundary.name = component.id;
      for (const auto& sensor : m_machine.sensors) {
        if (sensor.component == component.id && m_inputs.find(sensor.channel) != nullptr) {
          boundary.series = linear(sensor.channel);
        }
      }
      boundary.constant_C = boundary.series >= 0 ? 0.0 : reference_C(component.id);
      environment(std::move(boundary));
    } else if (component.lump) {
      add_lump(component);
    } else {
      add_rod(component);
    }
  }
}

void NetworkBuilder::add_couplings() {
  for (std::size_t i = 0; i < m_machine.couplings.size(); ++i) {
    const Coupling& coupling = m_machine.couplings[i];
    const Component& first = *m_machine.find(coupling.first.component);
    const Component& second = *m_machine.find(coupling.second.component);
    if (first.prescribed && second.prescribed) continue;
    Parameter g;
    g.key = "conductance_W_K";
    g.component = coupling_name(m_machine.couplings, i);
    if (coupling.conductance_W_K && *coupling.conductance_W_K > 0.0) {
      g.mean = g.start = *coupling.conductance_W_K;
      g.logarithmic = true;
      g.sigma = m_machine.tolerances.conductance;
    } else {
      // Unknown: somewhere around a time constant of an hour and a half, a factor of five either way.
      const Component& inner = first.prescribed ? second : first;
      const double capacity_J_K = inner.heat_capacity_J_K.value_or(stand_in_capacity_J_K);
      g.mean = g.start = capacity_J_K / 5000.0;
      g.logarithmic = true;
      g.sigma = 1.6;
      m_network.notes.push_back("conductance_unknown:" + g.component);
    }
    Term term;
    term.label = g.component;
    term.law_kind = LawKind::constant;
    term.parameters = {add_parameter(g)};
    term.law = [](const LawPoint& point) {
      Strength s;
      s.value = point.values[0];
      s.by_parameter[0] = 1.0;
      return s;
    };
    if (first.prescribed || second.prescribed) {
      const Component& boundary = first.prescribed ? first : second;
      const CouplingEnd& inner = first.prescribed ? coupling.second : coupling.first;
      term.kind = TermKind::film;
      const Probe at = probe_at(inner.component, inner.position_mm);
      term.first_node =
          std::max_element(at.begin(), at.end(), [](auto& a, auto& b) { return a.second < b.second; })->first;
      term.weights = {1.0};
      for (std::size_t e = 0; e < m_network.environments.size(); ++e) {
        if (m_network.environments[e].name == boundary.id) term.environment = static_cast<int>(e);
      }
    } else {
      term.kind = TermKind::link;
      const Probe one = probe_at(first.id, coupling.first.position_mm);
      const Probe two = probe_at(second.id, coupling.second.position_mm);
      for (const auto& [a, wa] : one) {
        for (const auto& [b, wb] : two) {
          if (wa * wb > 0.0) term.links.push_back({a, b, wa * wb});
        }
      }
    }
    add(std::move(term));
  }
}

static Parameter lag_parameter(const Sensor& sensor) {
  Parameter lag;
  lag.key = "sensor_lag_s";
  lag.channel = sensor.channel;
  lag.mean = lag.start = sensor.lag_s;
  lag.sigma = sensor.lag_sigma_s;
  lag.low = 0.0;
  return lag;
}

void NetworkBuilder::add_sensors() {
  for (const auto& sensor : m_machine.sensors) {
    const Component* component = m_machine.find(sensor.component);
    if (component == nullptr || component->prescribed) continue;
    Observation seen;
    seen.channel = sensor.channel;
    seen.probe = probe(probe_at(component->id, sensor.position_mm));
    // What reads its rise wrong does so from the room on, where a warm start has left it long ago.
    seen.reference = reference_C(component->id) - start_above_room_K(m_machine, component->id, m_inputs);
    Parameter offset;
    offset.key = "offset_K";
    offset.channel = sensor.channel;
    offset.sigma = 0.5 * sensor.accuracy_C;  // as wide as the accuracy it would hide a faulty sensor
    offset.per_recording = offset.of_sensor = true;
    seen.offset = add_parameter(offset);
    if (sensor.lag_s > 0.0 || sensor.lag_sigma_s > 0.0) seen.lag_s = add_parameter(lag_parameter(sensor));
    if (component->inner) add_near_field(*component, sensor, seen);
    m_network.observations.push_back(std::move(seen));
  }
}

void NetworkBuilder::add_displacements() {
  for (const auto& displacement : m_machine.displacements) {
    Observation seen;
    seen.channel = displacement.channel;
    seen.temperature = false;
    seen.accuracy = displacement.accuracy_um;
    const Component* component = displacement.component.empty() ? nullptr : m_machine.find(displacement.component);
    const bool grows = component != nullptr && !component->prescribed && component->length_mm > 0.0 &&
                       component->material.expansion_1_K != 0.0 &&
                       (component->lump || !is_across(m_machine, displacement));
    if (grows) {
      Parameter alpha;
      alpha.key = "expansion_1_K";
      alpha.component = component->id;
      alpha.channel = displacement.channel;
      alpha.mean = alpha.start = component->material.expansion_1_K;
      alpha.sigma = m_machine.tolerances.expansion;
      alpha.logarithmic = true;
      seen.scale = add_parameter(alpha);
      const auto& at = place(component->id);
      const double cell_um = (at.cell_m == 0.0 ? component->length_mm * m_per_mm : at.cell_m) * 1e6 * displacement.sign;
      seen.reference = cell_um * at.count * reference_C(component->id);
      seen.probe = probe(length_probe(at, at.first, cell_um));
      if (at.inner >= 0) {
        seen.inner_probe = probe(length_probe(at, at.inner, cell_um));
        Parameter share;
        share.key = "inner_growth_share";
        share.component = component->id;
        share.mean = share.start = component->inner->growth_share;
        share.sigma = component->inner->shaft_in_cartridge ? 0.3 : 0.0;
        share.low = 0.0;
        share.high = 1.0;
        seen.inner_share = add_parameter(share);
      }
    }
    Parameter offset;
    offset.key = "offset_um";
    offset.channel = displacement.channel;
    // A probe is set to zero at some moment: on a machine that starts warm that says little, and one that does not
    // start at zero was set before.
    const double first_um = first_value(m_inputs, displacement.channel);
    offset.sigma =
        std::max(starts_warm(m_machine, m_inputs) ? 30.0 : 1.5, std::isfinite(first_um) ? std::abs(first_um) : 0.0);
    offset.per_recording = true;
    seen.offset = add_parameter(offset);
    m_network.observations.push_back(std::move(seen));
  }
}

void NetworkBuilder::build() {
  m_initial_C = initial_temperatures(m_machine, m_inputs);
  m_mean_initial_C = mean_initial_temperature_C(m_machine, m_inputs);
  Parameter hold;
  hold.key = "hold";
  // An input switches anywhere between two samples, unless its time is known better (or worse).
  constexpr double anywhere = 0.3;  // of a sample interval, one sigma
  hold.sigma = anywhere;
  const std::vector<double>& time_s = m_inputs.time_s;
  if (m_machine.input_timing_sigma_s > 0.0 && time_s.size() > 1) {
    const double interval_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size() - 1);
    hold.sigma = std::max(1e-3, m_machine.input_timing_sigma_s / interval_s);
  }
  hold.mean = std::min(anywhere, hold.sigma);
  hold.low = 0.0;
  hold.high = 1.0;
  hold.start = 0.0;
  hold.per_recording = true;
  m_network.hold_parameter = add_parameter(hold);
  add_components();
  add_initial_state();
  add_sensors();
  add_displacements();
  for (std::size_t i = 0; i < m_machine.effects.size(); ++i) {
    const EffectSpec& spec = m_machine.effects[i];
    find_effect(spec.id)->add(*this, spec, static_cast<int>(i));
  }
  add_sources();
  add_couplings();
  add_past();
}

Network build_network(const Machine& machine, const recording::Recording& inputs, const BuildOptions& options) {
  NetworkBuilder builder(machine, inputs, options);
  builder.build();
  return std::move(builder.network());
}

}  // namespace zerodrift::physics
