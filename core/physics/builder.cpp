#include "core/physics/builder.h"

#include <algorithm>
#include <cmath>

#include "core/physics/initial_state.h"
#include "core/physics/sources.h"

namespace zerodrift::physics {
namespace {

constexpr double mm = 1e-3;
/// A lump of unknown capacity: only ratios to it can be identified.
constexpr double stand_in_capacity_J_K = 1000.0;

int index_in(std::vector<std::string>& list, const std::string& name) {
  const auto at = std::find(list.begin(), list.end(), name);
  if (at != list.end()) return static_cast<int>(at - list.begin());
  list.push_back(name);
  return static_cast<int>(list.size()) - 1;
}

double full_speed(const Machine& machine, const recording::Recording& inputs) {
  double rpm = machine.rated_speed_rpm();
  const recording::Channel* speed = inputs.find("spindle_rpm");
  if (rpm > 0.0 || speed == nullptr) return std::max(rpm, 1.0);
  for (const double value : speed->values) {
    if (std::isfinite(value)) rpm = std::max(rpm, std::abs(value));
  }
  return std::max(rpm, 1.0);
}

}  // namespace

const Network::Place* Network::place(const std::string& component) const {
  for (const auto& one : places) {
    if (one.component == component) return &one;
  }
  return nullptr;
}

const Observation* Network::observation(const std::string& channel) const {
  for (const auto& one : observations) {
    if (one.channel == channel) return &one;
  }
  return nullptr;
}

Observation* Network::observation(const std::string& channel) {
  return const_cast<Observation*>(std::as_const(*this).observation(channel));
}

std::vector<double> Network::start_values() const {
  std::vector<double> values;
  values.reserve(parameters.size());
  for (const auto& parameter : parameters) values.push_back(parameter.start);
  return values;
}

NetworkBuilder::NetworkBuilder(const Machine& machine, const recording::Recording& inputs, const BuildOptions& options)
    : m_machine(machine), m_inputs(inputs), m_options(options) {
  m_network.full_speed_rpm = full_speed(machine, inputs);
}

const Network::Place& NetworkBuilder::place(const std::string& component) const {
  return *m_network.place(component);
}

double NetworkBuilder::reference_C(const std::string& component) const {
  const auto at = m_initial_C.find(component);
  return at == m_initial_C.end() ? m_mean_initial_C : at->second;
}

int NetworkBuilder::add_parameter(Parameter parameter) {
  m_network.parameters.push_back(std::move(parameter));
  return static_cast<int>(m_network.parameters.size()) - 1;
}

int NetworkBuilder::effect_parameter(const EffectSpec& spec, int index, std::string_view key, double value) {
  const EffectParameter& known = find_effect(spec.id)->parameter(key);
  Parameter p;
  p.key = std::string(key);
  p.component = spec.word_or("component", "");
  p.channel = spec.word_or("channel", "");
  p.effect = index;
  p.low = known.low;
  p.high = known.high;
  const double given = spec.number_or(p.key, value);
  p.start = given;
  const double sigma = spec.number_or(p.key + "_prior_sigma", known.sigma);
  if (spec.candidate) {
    p.amplitude = known.amplitude;
    p.mean = known.amplitude ? 0.0 : known.mean != 0.0 ? known.mean : given;
    p.sigma = sigma;
    p.logarithmic = known.logarithmic;
  } else if (known.amplitude && given > 0.0) {
    p.mean = given;
    p.logarithmic = true;
    p.sigma = m_machine.tolerances.film;
    p.low = std::max(p.low, given * 1e-3);
  } else {  // a described place or exponent stands as described
    p.mean = given;
    p.sigma = 0.0;
  }
  return add_parameter(p);
}

int NetworkBuilder::held(const std::string& channel) {
  return index_in(m_network.held_channels, channel);
}

int NetworkBuilder::linear(const std::string& channel) {
  return index_in(m_network.linear_channels, channel);
}

int NetworkBuilder::signal(Signal signal) {
  m_network.signals.push_back(std::move(signal));
  return static_cast<int>(m_network.signals.size()) - 1;
}

int NetworkBuilder::probe(Probe probe) {
  m_network.probes.push_back(std::move(probe));
  return static_cast<int>(m_network.probes.size()) - 1;
}

int NetworkBuilder::environment(Environment environment) {
  m_network.environments.push_back(std::move(environment));
  return static_cast<int>(m_network.environments.size()) - 1;
}

int NetworkBuilder::room() {
  if (m_room >= 0) return m_room;
  Environment room;
  room.name = "room";
  if (!m_machine.room.channel.empty() && m_inputs.find(m_machine.room.channel) != nullptr) {
    room.series = linear(m_machine.room.channel);
  } else {
    room.constant_C = m_machine.room.temperature_C.value_or(m_mean_initial_C);
    Parameter p;
    p.key = "room_temperature_K";
    p.sigma = m_machine.room.sigma_C;
    p.per_recording = true;
    room.parts.push_back({add_parameter(p), -1});
    m_network.notes.emplace_back(m_machine.room.temperature_C ? "room_given" : "room_is_initial_temperature");
  }
  return m_room = environment(std::move(room));
}

int NetworkBuilder::add_node(double volume, int capacity_parameter, double initial_C) {
  m_network.volume.push_back(volume);
  m_network.capacity_parameter.push_back(capacity_parameter);
  m_network.initial_C.push_back(initial_C);
  return static_cast<int>(m_network.nodes()) - 1;
}

Term NetworkBuilder::source_over(const std::string& component, double from_mm, double to_mm) const {
  const auto& at = place(component);
  Term term;
  term.kind = TermKind::source;
  term.first_node = at.first;
  if (at.cell_m == 0.0) {
    term.weights = {1.0};
    return term;
  }
  const double cell_mm = at.cell_m / mm;
  const int low = std::clamp(static_cast<int>(std::floor(from_mm / cell_mm + 1e-9)), 0, at.count - 1);
  const int high = std::clamp(static_cast<int>(std::ceil(to_mm / cell_mm - 1e-9)), low + 1, at.count);
  term.first_node = at.first + low;
  for (int i = low; i < high; ++i) {
    const double overlap = std::min(to_mm, (i + 1) * cell_mm) - std::max(from_mm, i * cell_mm);
    term.weights.push_back(std::max(0.0, overlap) / (to_mm - from_mm));
  }
  return term;
}

Term NetworkBuilder::film_over(const std::string& component, double from_mm, double to_mm) const {
  Term term = source_over(component, from_mm, to_mm);
  term.kind = TermKind::film;
  const Component& described = *m_machine.find(component);
  const double area_m2 =
      described.lump ? 1e-6 * described.area_mm2.value_or(0.0) : described.perimeter_m() * (to_mm - from_mm) * mm;
  for (double& weight : term.weights) weight *= area_m2;
  return term;
}

Term NetworkBuilder::source_at(const std::string& component, int place_parameter, double width_mm) const {
  const auto at = place(component);
  Term term;
  term.kind = TermKind::source;
  term.first_node = at.first;
  term.weights.assign(at.count, at.cell_m == 0.0 ? 1.0 : 0.0);
  if (at.cell_m == 0.0) return term;
  term.place_parameter = place_parameter;
  const double cell_mm = at.cell_m / mm;
  // Normalised on the grid, so that all the heat enters whatever the width is.
  term.reshape = [at, cell_mm, width_mm](double place_mm, std::vector<double>& weights, std::vector<double>& by_place) {
    weights.resize(at.count);
    by_place.resize(at.count);
    double sum = 0.0;
    double sum_by = 0.0;
    for (int i = 0; i < at.count; ++i) {
      const double u = ((i + 0.5) * cell_mm - place_mm) / width_mm;
      weights[i] = std::exp(-0.5 * u * u);
      by_place[i] = weights[i] * u / width_mm;
      sum += weights[i];
      sum_by += by_place[i];
    }
    for (int i = 0; i < at.count; ++i) {
      weights[i] /= sum;
      by_place[i] = (by_place[i] - weights[i] * sum_by) / sum;
    }
  };
  return term;
}

Probe NetworkBuilder::probe_at(const std::string& component, double position_mm) const {
  const auto& at = place(component);
  if (at.cell_m == 0.0) return {{at.first, 1.0}};
  const double u = position_mm * mm / at.cell_m - 0.5;
  const int last = at.first + at.count - 1;
  if (at.count < 2) return {{at.first, 1.0}};
  // Within half a cell of an adiabatic end the field is a parabola with zero slope at the end: T = a + b x^2.
  const auto towards_end = [](double from_end_cells, int end, int inner) -> Probe {
    const double w = 0.125 - 0.5 * from_end_cells * from_end_cells;
    return {{end, 1.0 + w}, {inner, -w}};
  };
  if (u < 0.0) return towards_end(u + 0.5, at.first, at.first + 1);
  if (u > at.count - 1.0) return towards_end(at.count - 0.5 - u, last, last - 1);
  const int i = std::min(static_cast<int>(u), at.count - 2);
  return {{at.first + i, 1.0 - (u - i)}, {at.first + i + 1, u - i}};
}

Probe NetworkBuilder::mean_probe(const std::string& component) const {
  const auto& at = place(component);
  Probe mean;
  for (int i = 0; i < at.count; ++i) mean.emplace_back(at.first + i, 1.0 / at.count);
  return mean;
}

Term& NetworkBuilder::add(Term term) {
  m_network.terms.push_back(std::move(term));
  return m_network.terms.back();
}

void NetworkBuilder::modify_bearing(const std::string& source, BearingModifier modifier) {
  m_modifiers[source].push_back(modifier);
}

void NetworkBuilder::put_body_before(const std::string& source, Term contact) {
  m_bodies[source] = std::move(contact);
}

Term* NetworkBuilder::term(const std::string& label) {
  for (auto& one : m_network.terms) {
    if (one.label == label) return &one;
  }
  return nullptr;
}

std::vector<std::string> NetworkBuilder::rods() const {
  std::vector<std::string> ids;
  for (const auto& component : m_machine.components) {
    if (!component.lump) ids.push_back(component.id);
  }
  return ids;
}

void NetworkBuilder::add_rod(const Component& component) {
  Network::Place at;
  at.component = component.id;
  at.first = static_cast<int>(m_network.nodes());
  at.count = m_options.cells;
  at.cell_m = component.length_mm * mm / at.count;
  m_network.places.push_back(at);
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
  const double section_m2 = component.section_m2();
  for (int i = 0; i < at.count; ++i) {
    add_node(m.density_kg_m3 * section_m2 * at.cell_m, m_capacity[component.id], reference_C(component.id));
  }
  Term conduction;
  conduction.kind = TermKind::link;
  conduction.law_kind = LawKind::constant;
  conduction.label = component.id + "/conduction";
  for (int i = 0; i + 1 < at.count; ++i)
    conduction.links.push_back({at.first + i, at.first + i + 1, section_m2 / at.cell_m});
  conduction.parameters = {m_conductivity[component.id]};
  conduction.law = [](const LawPoint& point) {
    Strength s;
    s.value = point.values[0];
    s.by_parameter[0] = 1.0;
    return s;
  };
  add(std::move(conduction));
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
    c.sigma = m_machine.tolerances.heat_capacity;
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

void NetworkBuilder::add_initial_state() {
  const auto warm = warm_start_profiles(m_machine, m_inputs);
  for (const auto& at : m_network.places) {
    double accuracy_C = 0.0;
    int sensors = 0;
    for (const auto& sensor : m_machine.sensors) {
      if (sensor.component == at.component) accuracy_C += sensor.accuracy_C, ++sensors;
    }
    // The start temperature is known from the description, or from the mean of the sensors with their offsets.
    const double from_sensors_K = sensors == 0 ? 1.0 : accuracy_C / sensors / std::sqrt(sensors);
    Parameter level;
    level.key = "initial_temperature_K";
    level.component = at.component;
    level.sigma = m_machine.initial_temperature_C ? 0.15 : std::max(0.15, from_sensors_K);
    level.per_recording = true;
    InitialPart uniform{add_parameter(level), {}};
    for (int i = 0; i < at.count; ++i) uniform.nodes.emplace_back(at.first + i, 1.0);
    m_network.initial_parts.push_back(std::move(uniform));
    if (at.cell_m == 0.0) continue;
    Parameter tilt = level;
    tilt.key = "initial_tilt_K";
    InitialPart slope{add_parameter(tilt), {}};
    for (int i = 0; i < at.count; ++i) slope.nodes.emplace_back(at.first + i, (i + 0.5) / at.count - 0.5);
    m_network.initial_parts.push_back(std::move(slope));
    const auto profile = warm.find(at.component);
    if (profile == warm.end()) continue;
    for (int i = 0; i < at.count; ++i) {
      m_network.initial_C[at.first + i] = profile_at(profile->second, (i + 0.5) * at.cell_m / mm);
    }
    m_network.notes.push_back("warm_start:" + at.component);
  }
}

void NetworkBuilder::add_source(const Component& component, const HeatSource& source) {
  if (component.prescribed) return;
  Term term = source_over(component.id, source.from_mm, source.to_mm);
  if (const auto body = m_bodies.find(source.id); body != m_bodies.end()) {
    // The heat enters the source's own body; the body's contact spreads it over the same place.
    for (std::size_t i = 0; i < term.weights.size(); ++i) {
      body->second.links.push_back({body->second.first_node, term.first_node + static_cast<int>(i), term.weights[i]});
    }
    term.first_node = body->second.first_node;
    term.weights = {1.0};
    add(body->second);
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
    add(std::move(term));
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
      term.law_kind = LawKind::state;
      for (std::size_t i = 0; i < term.weights.size(); ++i) {
        term.driver.emplace_back(term.first_node + static_cast<int>(i), term.weights[i]);
      }
    }
  } else if (source.kind == SourceKind::input) {
    term.law = input_law(source.watts_per_unit, held(source.channel));
  } else {
    term.law = friction_law(source.friction_N, held(source.channel));
  }
  add(std::move(term));
}

void NetworkBuilder::add_sources() {
  for (const auto& component : m_machine.components) {
    for (const auto& source : component.sources) add_source(component, source);
  }
}

void NetworkBuilder::add_couplings() {
  for (const auto& coupling : m_machine.couplings) {
    const Component& first = *m_machine.find(coupling.first.component);
    const Component& second = *m_machine.find(coupling.second.component);
    if (first.prescribed && second.prescribed) continue;
    Parameter g;
    g.key = "conductance_W_K";
    g.component = first.id + "-" + second.id;
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

void NetworkBuilder::add_sensors() {
  for (const auto& sensor : m_machine.sensors) {
    const Component* component = m_machine.find(sensor.component);
    if (component == nullptr || component->prescribed) continue;
    Observation seen;
    seen.channel = sensor.channel;
    seen.probe = probe(probe_at(component->id, sensor.position_mm));
    seen.reference = reference_C(component->id);
    Parameter offset;
    offset.key = "offset_K";
    offset.channel = sensor.channel;
    offset.sigma = 0.5 * sensor.accuracy_C;  // as wide as the accuracy it would hide a faulty sensor
    offset.per_recording = true;
    seen.offset = add_parameter(offset);
    m_network.observations.push_back(std::move(seen));
  }
}

void NetworkBuilder::add_displacements() {
  for (const auto& displacement : m_machine.displacements) {
    Observation seen;
    seen.channel = displacement.channel;
    seen.temperature = false;
    const Component* component = displacement.component.empty() ? nullptr : m_machine.find(displacement.component);
    const bool across = displacement.direction == "X" || displacement.direction == "Y";
    const bool grows = component != nullptr && !component->prescribed && component->length_mm > 0.0 &&
                       component->material.expansion_1_K != 0.0 && (component->lump || !across);
    if (grows) {
      Parameter alpha;
      alpha.key = "expansion_1_K";
      alpha.component = component->id;
      alpha.channel = displacement.channel;
      alpha.mean = alpha.start = component->material.expansion_1_K;
      alpha.sigma = m_machine.tolerances.expansion;
      alpha.logarithmic = true;
      seen.scale = add_parameter(alpha);
      Probe length_um;
      const auto& at = place(component->id);
      const double cell_um = (at.cell_m == 0.0 ? component->length_mm * mm : at.cell_m) * 1e6 * displacement.sign;
      for (int i = 0; i < at.count; ++i) {
        length_um.emplace_back(at.first + i, cell_um);
        seen.reference += cell_um * reference_C(component->id);
      }
      seen.probe = probe(std::move(length_um));
    }
    Parameter offset;
    offset.key = "offset_um";
    offset.channel = displacement.channel;
    // A probe is set to zero at some moment: on a machine that starts warm that says little.
    offset.sigma = warm_start_profiles(m_machine, m_inputs).empty() ? 1.5 : 30.0;
    offset.per_recording = true;
    seen.offset = add_parameter(offset);
    m_network.observations.push_back(std::move(seen));
  }
}

void NetworkBuilder::build() {
  m_initial_C = initial_temperatures(m_machine, m_inputs);
  double sum = 0.0;
  for (const auto& [id, value] : m_initial_C) sum += value;
  if (!m_initial_C.empty()) m_mean_initial_C = sum / static_cast<double>(m_initial_C.size());
  Parameter hold;
  hold.key = "hold";
  hold.mean = 0.3;
  hold.sigma = 0.3;
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
}

Network build_network(const Machine& machine, const recording::Recording& inputs, const BuildOptions& options) {
  NetworkBuilder builder(machine, inputs, options);
  builder.build();
  return std::move(builder.network());
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
