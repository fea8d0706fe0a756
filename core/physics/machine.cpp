#include "core/physics/machine.h"

#include <algorithm>
#include <numbers>

namespace zerodrift::physics {

double Component::section_m2() const {
  const double outer_m = 1e-3 * outer_diameter_mm;
  const double bore_m = 1e-3 * bore_diameter_mm;
  return 0.25 * std::numbers::pi * (outer_m * outer_m - bore_m * bore_m);
}

double Component::perimeter_m() const {
  return 1e-3 * std::numbers::pi * outer_diameter_mm;
}

const HeatSource* Component::source_near(double position_mm) const {
  const HeatSource* nearest = nullptr;
  double least_mm = 0.25 * outer_diameter_mm;
  for (const auto& source : sources) {
    const bool near =
        source.kind == SourceKind::bearing || source.kind == SourceKind::motor || source.kind == SourceKind::guide;
    if (!near) continue;
    const double off_mm = std::max({0.0, source.from_mm - position_mm, position_mm - source.to_mm});
    if (off_mm < least_mm) least_mm = off_mm, nearest = &source;
  }
  return nearest;
}

double EffectSpec::number_or(const std::string& key, double fallback) const {
  const auto at = numbers.find(key);
  return at == numbers.end() ? fallback : at->second;
}

std::string EffectSpec::word_or(const std::string& key, const std::string& fallback) const {
  const auto at = words.find(key);
  return at == words.end() ? fallback : at->second;
}

const Component* Machine::find(const std::string& id) const {
  for (const auto& component : components) {
    if (component.id == id) return &component;
  }
  return nullptr;
}

std::string coupling_name(const std::vector<Coupling>& couplings, std::size_t index) {
  const auto between = [&](std::size_t i) {
    return couplings[i].first.component + "-" + couplings[i].second.component;
  };
  int before = 0;
  for (std::size_t i = 0; i < index; ++i) before += between(i) == between(index) ? 1 : 0;
  return before == 0 ? between(index) : between(index) + ":" + std::to_string(before + 1);
}

bool is_across(const Machine& machine, const Displacement& displacement) {
  if (displacement.direction != "X") return displacement.direction == "Y";
  return std::any_of(machine.displacements.begin(), machine.displacements.end(), [&](const Displacement& other) {
    return other.component == displacement.component && (other.direction == "Z" || other.direction == "Y");
  });
}

const Sensor* Machine::sensor(const std::string& channel) const {
  for (const auto& one : sensors) {
    if (one.channel == channel) return &one;
  }
  return nullptr;
}

std::set<std::string> measured_boundaries(const Machine& machine) {
  std::set<std::string> channels{machine.room.channel};
  for (const auto& fluid : machine.fluids) channels.insert(fluid.temperature_channel);
  for (const auto& sensor : machine.sensors) {
    const Component* component = machine.find(sensor.component);
    if (component != nullptr && component->prescribed) channels.insert(sensor.channel);
  }
  return channels;
}

const EffectSpec* Machine::effect(const std::string& id) const {
  for (const auto& one : effects) {
    if (one.id == id) return &one;
  }
  return nullptr;
}

double Machine::rated_speed_rpm() const {
  double rated_rpm = 0.0;
  for (const auto& component : components) {
    for (const auto& source : component.sources) {
      if (source.kind == SourceKind::motor) rated_rpm = std::max(rated_rpm, source.rated_speed_rpm);
    }
  }
  return rated_rpm;
}

}  // namespace zerodrift::physics
