#include "app/machine/parameters.h"

#include <algorithm>
#include <utility>

#include "core/base/noise.h"

namespace zerodrift::machine {

MachineParameters build_machine(std::uint64_t seed, HiddenEffects hidden) {
  MachineParameters built;
  built.seed = seed;
  Noise noise(seed * 0xD1B54A32D192ED03ULL + 11);
  const auto scatter = [&noise](double& factor, double sigma) {
    factor *= 1.0 + sigma * std::clamp(noise.normal(), -2.0, 2.0);
  };
  scatter(built.conductivity, 0.03);
  scatter(built.capacity, 0.02);
  scatter(built.expansion, 0.02);
  scatter(built.film, 0.06);
  scatter(built.front_heat, 0.06);
  scatter(built.rear_heat, 0.06);
  scatter(built.motor_heat, 0.06);
  scatter(built.contact, 0.15);
  scatter(built.structure_film, 0.1);
  scatter(built.screw_friction, 0.1);
  scatter(built.drive_heat, 0.1);
  for (double* share : {&built.head_share, &built.column_share, &built.table_share, &built.screw_share,
                        &built.bending_share, &built.side_share}) {
    scatter(*share, 0.15);
  }
  built.room_start_C = noise.uniform(19.5, 22.5);
  built.room_day_amplitude_K = noise.uniform(1.0, 2.0);
  built.room_phase_h = noise.uniform(6.0, 10.0);
  for (double& offset : built.sensor_offset_K) offset = noise.uniform(-0.08, 0.08);
  built.hidden = std::move(hidden);
  return built;
}

}  // namespace zerodrift::machine
