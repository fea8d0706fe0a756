#pragma once
// One built machine: the drawing's numbers with the scatter of its build, drawn from the seed, and the hidden effect.

#include <array>
#include <cstdint>

#include "app/machine/hidden_effect.h"

namespace zerodrift::machine {

inline constexpr int sensor_count = 20;

struct MachineParameters {
  std::uint64_t seed = 1;
  // factors on the drawing's numbers
  double conductivity = 1.0;
  double capacity = 1.0;
  double expansion = 1.0;
  double film = 1.0;
  double front_heat = 1.0;
  double rear_heat = 1.0;
  double motor_heat = 1.0;
  double contact = 1.0;
  double structure_film = 1.0;
  double screw_friction = 1.0;
  double drive_heat = 1.0;
  // signs and sizes of the structure's share in the errors
  double head_share = 1.0;
  double column_share = 1.0;
  double table_share = 1.0;
  double screw_share = 1.0;
  double bending_share = 1.0;
  double side_share = 1.0;
  // room
  double room_start_C = 21.0;
  double room_day_amplitude_K = 1.6;
  double room_phase_h = 8.0;  // hour of the day at the start
  std::array<double, sensor_count> sensor_offset_K{};
  std::uint64_t noise_day = 0;  // another day: other noise and weather, the same machine
  HiddenEffects hidden;
};

/// What a description states of a machine or a re-fit frees: factors of its build, with how well each is known.
struct OrdinaryNumber {
  double MachineParameters::*factor;
  double tolerance;
};
inline constexpr std::array ordinary_numbers{
    OrdinaryNumber{&MachineParameters::conductivity, 0.05}, OrdinaryNumber{&MachineParameters::capacity, 0.04},
    OrdinaryNumber{&MachineParameters::expansion, 0.04},    OrdinaryNumber{&MachineParameters::film, 0.15},
    OrdinaryNumber{&MachineParameters::front_heat, 0.15},   OrdinaryNumber{&MachineParameters::rear_heat, 0.15},
    OrdinaryNumber{&MachineParameters::motor_heat, 0.15},   OrdinaryNumber{&MachineParameters::contact, 0.3}};

MachineParameters build_machine(std::uint64_t seed, HiddenEffects hidden = {});

}  // namespace zerodrift::machine
