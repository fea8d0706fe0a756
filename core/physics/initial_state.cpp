#include "core/physics/initial_state.h"

#include <algorithm>
#include <cmath>

#include "core/physics/builder.h"
#include "core/physics/inputs.h"

namespace zerodrift::physics {

double first_value(const recording::Recording& recording, const std::string& channel) {
  const recording::Channel* found = recording.find(channel);
  if (found == nullptr) return std::nan("");
  // The median of the first three samples: one spike at the start must not become the start temperature.
  std::vector<double> first;
  for (std::size_t i = 0; i < found->values.size() && first.size() < 3; ++i) {
    if (std::isfinite(found->values[i])) first.push_back(found->values[i]);
  }
  if (first.empty()) return std::nan("");
  std::sort(first.begin(), first.end());
  return first[first.size() / 2];
}

std::map<std::string, double> initial_temperatures(const Machine& machine, const recording::Recording& inputs) {
  std::map<std::string, double> result;
  double sum = 0.0;
  int count = 0;
  for (const auto& component : machine.components) {
    std::vector<double> seen;
    for (const auto& sensor : machine.sensors) {
      const double value = sensor.component == component.id ? first_value(inputs, sensor.channel) : std::nan("");
      if (std::isfinite(value)) seen.push_back(value);
    }
    if (!seen.empty()) {
      for (const double value : seen) sum += value;
      count += static_cast<int>(seen.size());
      std::sort(seen.begin(), seen.end());
      double middle = 0.0;
      for (const double value : seen) middle += value / static_cast<double>(seen.size());
      result[component.id] = seen.size() >= 5 ? seen[seen.size() / 2] : middle;
    }
    if (machine.initial_temperature_C) result[component.id] = *machine.initial_temperature_C;
  }
  double elsewhere_C = count > 0 ? sum / count : machine.initial_temperature_C.value_or(20.0);
  if (machine.initial_temperature_C) elsewhere_C = *machine.initial_temperature_C;
  for (const auto& component : machine.components) result.emplace(component.id, elsewhere_C);
  return result;
}

double mean_initial_temperature_C(const Machine& machine, const recording::Recording& inputs) {
  double sum = 0.0;
  int count = 0;
  for (const auto& [id, value] : initial_temperatures(machine, inputs)) {
    if (machine.find(id)->prescribed) continue;
    sum += value;
    ++count;
  }
  return count > 0 ? sum / count : machine.initial_temperature_C.value_or(20.0);
}

std::map<std::string, Profile> warm_start_profiles(const Machine& machine, const recording::Recording& inputs) {
  std::map<std::string, Profile> warm;
  const auto initial = initial_temperatures(machine, inputs);
  for (const auto& component : machine.components) {
    if (component.lump) continue;
    Profile profile;
    int beyond = 0;
    for (const auto& sensor : machine.sensors) {
      if (sensor.component != component.id) continue;
      const double value = first_value(inputs, sensor.channel);
      if (!std::isfinite(value)) continue;
      profile.emplace_back(sensor.position_mm, value);
      if (std::abs(value - initial.at(component.id)) > std::max(0.8, 5.0 * sensor.accuracy_C)) ++beyond;
    }
    std::sort(profile.begin(), profile.end());
    if (beyond >= 2) warm[component.id] = std::move(profile);
  }
  return warm;
}

double start_above_room_K(const Machine& machine, const std::string& component, const recording::Recording& inputs) {
  constexpr double rested_K = 2.0;  // a room goes up and down by as much overnight, and its sensor may be wrong
  double room_C = first_value(inputs, machine.room.channel);
  if (!std::isfinite(room_C)) room_C = machine.room.temperature_C.value_or(std::nan(""));
  std::vector<double> seen_C;
  for (const auto& sensor : machine.sensors) {
    const double value_C = sensor.component == component ? first_value(inputs, sensor.channel) : std::nan("");
    if (std::isfinite(value_C)) seen_C.push_back(value_C);
  }
  if (seen_C.empty() || !std::isfinite(room_C)) return 0.0;
  std::sort(seen_C.begin(), seen_C.end());
  const double above_K = seen_C[seen_C.size() / 2] - room_C;
  return std::abs(above_K) > rested_K ? above_K : 0.0;
}

bool starts_warm(const Machine& machine, const recording::Recording& inputs) {
  if (!warm_start_profiles(machine, inputs).empty()) return true;
  if (std::any_of(machine.components.begin(), machine.components.end(), [&](const Component& component) {
        return !component.lump && start_above_room_K(machine, component.id, inputs) != 0.0;
      })) {
    return true;
  }
  std::vector<double> parts_C;  // what is driven from outside
  std::vector<double> others_C;
  double least_K = 0.8;
  for (const auto& sensor : machine.sensors) {
    const Component* component = machine.find(sensor.component);
    const double value = first_value(inputs, sensor.channel);
    if (component == nullptr || !std::isfinite(value)) continue;
    (component->prescribed ? parts_C : others_C).push_back(value);
    least_K = std::max(least_K, 5.0 * sensor.accuracy_C);
  }
  if (others_C.empty()) return false;
  const double rest_C = *std::max_element(others_C.begin(), others_C.end());
  return std::count_if(parts_C.begin(), parts_C.end(), [&](double value) { return value > rest_C + least_K; }) >= 2;
}

double uneven_start_K(const Machine& machine, const std::string& component, const recording::Recording& inputs) {
  constexpr double widths = 4.0;  // between the largest and the smallest of some values that are noise alone
  double low_C = 1e300;
  double high_C = -1e300;
  double alike_K = 0.0;
  for (const auto& sensor : machine.sensors) {
    const double value_C = sensor.component == component ? first_value(inputs, sensor.channel) : std::nan("");
    if (!std::isfinite(value_C)) continue;
    low_C = std::min(low_C, value_C);
    high_C = std::max(high_C, value_C);
    const double noise_K = noise_width(inputs.find(sensor.channel)->values, 0.01);
    alike_K = std::max(alike_K, 2.0 * sensor.accuracy_C + widths * noise_K);
  }
  return std::max(0.0, high_C - low_C - alike_K);
}

double profile_at(const Profile& profile, double position_mm) {
  if (position_mm <= profile.front().first) return profile.front().second;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    if (position_mm > profile[i].first) continue;
    const auto& [x0, t0] = profile[i - 1];
    const auto& [x1, t1] = profile[i];
    return x1 > x0 ? t0 + (t1 - t0) * (position_mm - x0) / (x1 - x0) : t1;
  }
  return profile.back().second;
}

}  // namespace zerodrift::physics
