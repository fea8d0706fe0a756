// How a run starts: its temperatures as the first samples have them, and what is left open of them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/physics/builder.h"
#include "core/physics/initial_state.h"
#include "core/physics/simulator.h"

namespace zerodrift::physics {
namespace {

/// Moments of a machine that only heats up: each is about 1.4 times the one before.
std::vector<double> growing_times_s(double first_s, double last_s) {
  std::vector<double> times_s{0.0};
  for (double time_s = first_s; time_s < last_s * (1.0 - 1e-9); time_s *= std::numbers::sqrt2)
    times_s.push_back(time_s);
  times_s.push_back(last_s);
  return times_s;
}

/// The same machine at 0 C in surroundings of 0 C, with nothing that heats.
Network at_rest(const Network& network) {
  Network rest = network;
  std::erase_if(rest.terms, [](const Term& term) { return term.kind == TermKind::source; });
  for (auto& environment : rest.environments) {
    environment.series = -1;
    environment.constant_C = 0.0;
    environment.parts.clear();
  }
  std::fill(rest.initial_C.begin(), rest.initial_C.end(), 0.0);
  rest.initial_parts.clear();
  rest.observations.clear();
  rest.probes.clear();
  rest.signals.clear();
  return rest;
}

/// The same moments with every input at its largest.
InputSet at_full(const Network& network, const recording::Recording& recording, std::vector<double> times_s) {
  std::vector<double> largest;
  for (const auto& name : network.held_channels) {
    double most = 0.0;
    const recording::Channel* channel = recording.find(name);
    for (const double value : channel == nullptr ? std::vector<double>{} : channel->values) {
      if (std::isfinite(value)) most = std::max(most, std::abs(value));
    }
    largest.push_back(most);
  }
  InputSet inputs;
  inputs.time_s = std::move(times_s);
  inputs.held.assign(inputs.rows(), largest);
  inputs.linear.assign(inputs.rows(), std::vector<double>(network.linear_channels.size(), 0.0));
  inputs.signals.assign(inputs.rows(), {});
  inputs.settled.assign(inputs.rows(), false);
  return inputs;
}

}  // namespace

void NetworkBuilder::add_initial_state() {
  // From end to end, after a rest: steel evens out over half a metre within half an hour.
  constexpr double even_K = 0.05;
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
    for (int i = 0; i < at.count && at.inner >= 0; ++i) uniform.nodes.emplace_back(at.inner + i, 1.0);
    m_network.initial_parts.push_back(std::move(uniform));
    if (at.cell_m == 0.0) continue;
    Parameter tilt = level;
    tilt.key = "initial_tilt_K";
    tilt.sigma = std::clamp(uneven_start_K(m_machine, at.component, m_inputs), even_K, level.sigma);
    InitialPart slope{add_parameter(tilt), {}};
    for (int i = 0; i < at.count; ++i) slope.nodes.emplace_back(at.first + i, (i + 0.5) / at.count - 0.5);
    for (int i = 0; i < at.count && at.inner >= 0; ++i)
      slope.nodes.emplace_back(at.inner + i, (i + 0.5) / at.count - 0.5);
    m_network.initial_parts.push_back(std::move(slope));
    const auto profile = warm.find(at.component);
    const double above_K = std::abs(start_above_room_K(m_machine, at.component, m_inputs));
    if (above_K > 0.0) add_start_shapes(at, above_K);
    if (above_K > 0.0 || profile != warm.end()) m_network.notes.push_back("warm_start:" + at.component);
    if (profile == warm.end()) continue;
    for (int i = 0; i < at.count; ++i) {
      m_network.initial_C[at.first + i] = profile_at(profile->second, (i + 0.5) * at.cell_m / m_per_mm);
      if (at.inner >= 0) m_network.initial_C[at.inner + i] = m_network.initial_C[at.first + i];
    }
  }
}

/// What ran before left a shape between the sensors that nobody saw: half waves along the rod, the longer the larger,
/// as conduction leaves them.
void NetworkBuilder::add_start_shapes(const Network::Place& at, double above_K) {
  constexpr double uneven = 0.1;  // of what the rod is above its room, for the half wave from end to end
  constexpr int half_waves = 5;
  for (int wave = 1; wave <= half_waves; ++wave) {
    Parameter shape;
    shape.key = fmt::format("initial_wave_{}_K", wave);
    shape.component = at.component;
    shape.sigma = uneven * above_K / wave;
    shape.per_recording = true;
    InitialPart part{add_parameter(shape), {}};
    for (int i = 0; i < at.count; ++i) {
      const double height = std::cos(std::numbers::pi * wave * (i + 0.5) / at.count);
      part.nodes.emplace_back(at.first + i, height);
      if (at.inner >= 0) part.nodes.emplace_back(at.inner + i, height);
    }
    m_network.initial_parts.push_back(std::move(part));
  }
}

/// What the sensors' first samples leave open between them, and inside: what each source would have left that had been
/// on for a while, less what is made of it by looking at the sensors alone. Amounts of both signs for several whiles
/// are on and off at several moments before.
void NetworkBuilder::add_past() {
  constexpr double first_s = 20.0;
  constexpr double shortest_s = 100.0;
  constexpr double times_longer = 4.0;
  constexpr int whiles = 5;  // 100 s, 7 min, 27 min, 2 h, 7 h
  double above_K = 0.0;
  for (const auto& at : m_network.places) {
    if (at.cell_m > 0.0) above_K = std::max(above_K, start_above_room_K(m_machine, at.component, m_inputs));
  }
  if (above_K <= 0.0) return;
  const double longest_s = shortest_s * std::pow(times_longer, whiles - 1);
  const Network rest = at_rest(m_network);
  const InputSet inputs = at_full(rest, m_inputs, growing_times_s(first_s, longest_s));
  SimulateOptions options;
  options.longest_step_s = longest_s;
  options.keep_field = true;
  for (const auto& component : m_machine.components) {
    for (const auto& source : component.sources) {
      const std::string label = component.id + "/" + source.id;
      Network heated = rest;
      std::copy_if(m_network.terms.begin(), m_network.terms.end(), std::back_inserter(heated.terms),
                   [&](const Term& term) {
                     return term.kind == TermKind::source && (term.label == label || term.label == label + "/inside");
                   });
      if (heated.terms.size() == rest.terms.size()) continue;
      const Trajectory run = run_network(heated, inputs, heated.start_values(), {}, options);
      for (int i = 0; i < whiles; ++i) {
        const double while_s = shortest_s * std::pow(times_longer, i);
        const auto row = std::lower_bound(inputs.time_s.begin(), inputs.time_s.end(), while_s) - inputs.time_s.begin();
        const auto begin = run.field_C.begin() + row * std::ssize(m_network.initial_C);
        add_past_shape(fmt::format("initial_past_{:.0f}_K:{}", while_s, source.id), component.id, above_K,
                       {begin, begin + std::ssize(m_network.initial_C)});
      }
    }
  }
}

void NetworkBuilder::add_past_shape(const std::string& key, const std::string& component, double above_K,
                                    const std::vector<double>& left_K) {
  const double most_K = *std::max_element(left_K.begin(), left_K.end());
  if (most_K < 1e-9) return;
  Parameter amount;
  amount.key = key;
  amount.component = component;
  amount.sigma = above_K;
  amount.per_recording = true;
  InitialPart part;
  for (const auto& at : m_network.places) {
    Profile seen;
    for (const auto& sensor : m_machine.sensors) {
      if (sensor.component != at.component || !std::isfinite(first_value(m_inputs, sensor.channel))) continue;
      double here_K = 0.0;
      for (const auto& [node, weight] : probe_at(sensor.component, sensor.position_mm)) here_K += weight * left_K[node];
      seen.emplace_back(sensor.position_mm, here_K);
    }
    if (seen.empty()) continue;
    std::sort(seen.begin(), seen.end());
    for (int i = 0; i < at.count; ++i) {
      const double told_K = profile_at(seen, (i + 0.5) * at.cell_m / m_per_mm);
      part.nodes.emplace_back(at.first + i, (left_K[at.first + i] - told_K) / most_K);
      if (at.inner >= 0) part.nodes.emplace_back(at.inner + i, (left_K[at.inner + i] - told_K) / most_K);
    }
  }
  part.parameter = add_parameter(amount);
  m_network.initial_parts.push_back(std::move(part));
}

}  // namespace zerodrift::physics
