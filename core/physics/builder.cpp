#include "core/physics/builder.h"

#include <algorithm>
#include <cmath>

#include "core/physics/hat.h"
#include "core/physics/initial_state.h"
#include "core/physics/sources.h"

namespace zerodrift::physics {
namespace {

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

std::vector<int> NetworkBuilder::interval_parameters(const EffectSpec& spec, int index) {
  std::vector<int> list;
  const auto edge = [&](const char* key, std::size_t i, double at_s) {
    Parameter p;
    p.key = std::string(key) + ":" + std::to_string(i);
    p.component = spec.word_or("component", "");
    p.channel = spec.word_or("channel", "");
    p.effect = index;
    p.mean = p.start = at_s;
    p.sigma = spec.candidate ? spec.number_or("edge_prior_sigma", 0.0) : 0.0;
    list.push_back(add_parameter(p));
  };
  for (std::size_t i = 0; i < spec.intervals_s.size(); ++i) {
    edge("from_s", i, spec.intervals_s[i].first);
    edge("to_s", i, spec.intervals_s[i].second);
  }
  return list;
}

int NetworkBuilder::place_parameter(const EffectSpec& spec, int index, const Component& rod) {
  const int place = effect_parameter(spec, index, "position_mm", 0.5 * rod.length_mm);
  Parameter& p = m_network.parameters[place];
  p.low = 0.01 * rod.length_mm;
  p.high = 0.99 * rod.length_mm;
  return place;
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
    // A room with a sensor that this recording has not: nobody knows how it went, and whatever it did must not look
    // like the machine's doing.
    if (!m_machine.room.channel.empty()) {
      m_network.notes.emplace_back("room_not_logged");
      wandering_room(room);
    }
  }
  return m_room = environment(std::move(room));
}

/// Straight between hidden temperatures at regular moments, each about as far from the mean as halls are in a shift.
void NetworkBuilder::wandering_room(Environment& room) {
  constexpr double wander_K = 1.5;
  constexpr double least_apart_s = 1800.0;
  constexpr double most_moments = 16.0;
  const double start_s = m_inputs.time_s.front();
  const double whole_s = m_inputs.time_s.back() - start_s;
  const double count = std::clamp(std::floor(whole_s / least_apart_s), 1.0, most_moments);
  const double apart_s = std::max(whole_s / count, 1.0);
  for (int i = 0; i <= static_cast<int>(count); ++i) {
    Parameter p;
    p.key = "room_wander_K:" + std::to_string(i);
    p.sigma = wander_K;
    p.per_recording = true;
    const double middle_s = start_s + i * apart_s;
    const int hat = signal({p.key, [middle_s, apart_s](const double*, const double*, double time_s) {
                              return std::max(0.0, 1.0 - std::abs(time_s - middle_s) / apart_s);
                            }});
    room.parts.push_back({add_parameter(p), hat});
  }
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
  constexpr double rounding = 1e-9;
  const double cell_mm = at.cell_m / m_per_mm;
  const double from = from_mm / cell_mm;
  const double to = to_mm / cell_mm;
  const int low = std::clamp(static_cast<int>(std::floor(from - 0.5 + rounding)), 0, at.count - 1);
  const int high = std::clamp(static_cast<int>(std::ceil(to + 0.5 - rounding)), low + 1, at.count);
  term.first_node = at.first + low;
  for (int i = low; i < high; ++i) {
    term.weights.push_back((hat_of_cell(i, at.count, to) - hat_of_cell(i, at.count, from)) / (to - from));
  }
  return term;
}

Term NetworkBuilder::film_over(const std::string& component, double from_mm, double to_mm) const {
  Term term = source_over(component, from_mm, to_mm);
  term.kind = TermKind::film;
  const Component& described = *m_machine.find(component);
  const double area_m2 =
      described.lump ? 1e-6 * described.area_mm2.value_or(0.0) : described.perimeter_m() * (to_mm - from_mm) * m_per_mm;
  for (double& weight : term.weights) weight *= area_m2;
  return term;
}

Term NetworkBuilder::film_up_to(const std::string& component, int place_parameter) const {
  const auto at = place(component);
  Term term;
  term.kind = TermKind::film;
  term.first_node = at.first;
  term.weights.assign(at.count, 0.0);
  term.place_parameter = place_parameter;
  const double cell_mm = at.cell_m / m_per_mm;
  const double perimeter_mm = m_machine.find(component)->perimeter_m() * m_per_mm;  // m2 for each mm of length
  term.reshape = [at, cell_mm, perimeter_mm](double place_mm, std::vector<double>& weights, std::vector<double>& by) {
    weights.resize(at.count);
    by.resize(at.count);
    for (int i = 0; i < at.count; ++i) {
      const double place = place_mm / cell_mm;
      weights[i] = perimeter_mm * cell_mm * hat_of_cell(i, at.count, place);
      by[i] = perimeter_mm * hat_at(i, at.count, place);
    }
  };
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
  const double cell_mm = at.cell_m / m_per_mm;
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
  const double u = position_mm * m_per_mm / at.cell_m - 0.5;
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

void NetworkBuilder::put_body_before(const std::string& source, int node, int contact) {
  m_bodies[source] = {node, contact};
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

}  // namespace zerodrift::physics
