#pragma once
// The twenty temperature sensors: where they sit, and what the controller reads of them: resistance thermometers with a
// small fixed offset, 0.1 C of white noise a conversion (one conversion a machine second), in steps of 1/16 C.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "app/machine/parameters.h"

namespace zerodrift::machine {

class ThermalNetwork;
class SpindleBody;
class StructureBody;

struct SensorPlace {
  std::string_view label;
  std::string_view place;             // component, for drawings
  double position_mm;                 // along the spindle from its fixed end; 0 elsewhere
  int (*node)(const StructureBody&);  // null: in the spindle
};

std::span<const SensorPlace, sensor_count> sensor_places();
double place_temperature_C(const SensorPlace& place, const ThermalNetwork& network, const SpindleBody& spindle,
                           const StructureBody& structure);

inline constexpr std::int16_t dead_reading = -32768;

/// Raw readings in 1/16 C; a reading depends on seed, sensor and second alone, so that runs repeat.
class SensorBoard {
 public:
  explicit SensorBoard(const MachineParameters& parameters) : m_parameters(parameters) {}

  /// sensor 1 to 20, or 0 for the room.
  std::int16_t reading(int sensor, double true_C, std::uint64_t second) const;
  /// What it would show without noise and steps: the truth, its own offset and hidden faults.
  double expected_C(int sensor, double true_C) const;

 private:
  MachineParameters m_parameters;
};

}  // namespace zerodrift::machine
