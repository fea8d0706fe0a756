#include "app/machine/sensors.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/machine/spindle_body.h"
#include "app/machine/structure_body.h"

namespace zerodrift::machine {
namespace {

constexpr double noise_sigma_C = 0.1;

template <Part which>
int part(const StructureBody& structure) {
  return structure.node(which);
}
template <int axis>
int nut(const StructureBody& structure) {
  return structure.nut_node(axis);
}
template <int axis>
int support(const StructureBody& structure) {
  return structure.support_node(axis);
}
int guide_x(const StructureBody& structure) {
  return structure.guide_node(0);
}

constexpr std::array<SensorPlace, sensor_count> places{{
    {"Spindle front bearing", "spindle", 345, nullptr},
    {"Spindle between front bearing and motor", "spindle", 260, nullptr},
    {"Spindle motor, front end", "spindle", 180, nullptr},
    {"Spindle motor, rear end", "spindle", 100, nullptr},
    {"Spindle rear bearing", "spindle", 25, nullptr},
    {"Headstock", "headstock", 0, part<Part::headstock>},
    {"Column front, top", "column_front", 0, part<Part::column_front_top>},
    {"Column rear, top", "column_rear", 0, part<Part::column_rear_top>},
    {"X screw nut", "screw_x", 0, nut<0>},
    {"X screw support bearing", "screw_x", 0, support<0>},
    {"Y screw nut", "screw_y", 0, nut<1>},
    {"Y screw support bearing", "screw_y", 0, support<1>},
    {"Z screw nut", "screw_z", 0, nut<2>},
    {"Z screw support bearing", "screw_z", 0, support<2>},
    {"X guide", "guide_x", 0, guide_x},
    {"A trunnion drive", "trunnion", 0, part<Part::drive_A>},
    {"C table drive", "table_drive", 0, part<Part::drive_C>},
    {"Table", "table", 0, part<Part::table>},
    {"Bed", "bed", 0, part<Part::bed_middle>},
    {"Coolant tank", "coolant", 0, part<Part::tank>},
}};

/// The finaliser of splitmix64 (Steele, Lea and Flood 2014): a well mixed number for a counter.
std::uint64_t mixed(std::uint64_t counter) {
  counter += 0x9E3779B97F4A7C15ULL;
  counter = (counter ^ (counter >> 30U)) * 0xBF58476D1CE4E5B9ULL;
  counter = (counter ^ (counter >> 27U)) * 0x94D049BB133111EBULL;
  return counter ^ (counter >> 31U);
}

double normal_of(std::uint64_t counter) {
  const auto uniform = [](std::uint64_t bits) { return (static_cast<double>(bits >> 11U) + 0.5) * 0x1.0p-53; };
  const std::uint64_t first = mixed(counter);
  return std::sqrt(-2.0 * std::log(uniform(first))) * std::cos(2.0 * std::numbers::pi * uniform(mixed(first)));
}

}  // namespace

std::span<const SensorPlace, sensor_count> sensor_places() {
  return places;
}

double place_temperature_C(const SensorPlace& place, const ThermalNetwork& network, const SpindleBody& spindle,
                           const StructureBody& structure) {
  if (place.node == nullptr) return spindle.housing_C(network, place.position_mm);
  return network.temperature_C(place.node(structure));
}

double SensorBoard::expected_C(int sensor, double true_C) const {
  if (sensor == 0) return true_C;
  double shown_C = true_C + m_parameters.sensor_offset_K[sensor - 1];
  for (const HiddenEffect& effect : m_parameters.hidden.list()) {
    if (effect.sensor != sensor) continue;
    if (effect.is("sensor_offset")) shown_C += effect.size;
    if (effect.is("sensor_gain")) shown_C += effect.size * (true_C - m_parameters.room_start_C);
  }
  return shown_C;
}

std::int16_t SensorBoard::reading(int sensor, double true_C, std::uint64_t second) const {
  const std::uint64_t counter = (m_parameters.seed << 40U) + (m_parameters.noise_day << 38U) + second * 64ULL +
                                static_cast<std::uint64_t>(sensor);
  const double shown_C = expected_C(sensor, true_C) + noise_sigma_C * normal_of(counter);
  return static_cast<std::int16_t>(std::lround(std::clamp(shown_C, -200.0, 600.0) * 16.0));
}

}  // namespace zerodrift::machine
