#pragma once
// The numbers of the drawing, as the maker of this machine would state them; each built machine differs from them by
// some percent (parameters.h). The machine description that is shipped (description.h) is written from these alone.

namespace zerodrift::machine::nominal {

// Spindle: shaft in a cartridge housing, x from its fixed rear end (0) to the nose.
inline constexpr double spindle_length_mm = 400.0;
inline constexpr double bore_diameter_mm = 20.0;
inline constexpr double shaft_diameter_mm = 70.0;
inline constexpr double housing_diameter_mm = 160.0;
inline constexpr double conductivity_W_mK = 44.0;
inline constexpr double density_kg_m3 = 7850.0;
inline constexpr double heat_capacity_J_kgK = 460.0;
inline constexpr double expansion_1_K = 1.15e-5;
inline constexpr double top_speed_rpm = 8000.0;

struct Bearing {
  double from_mm;
  double to_mm;
  double mean_diameter_mm;
  double f0;  // Palmgren: lubrication
  double f1;  // Palmgren: load
  double load_N;
  double viscosity_mm2_s;
};
inline constexpr Bearing front_bearing{320, 355, 77.5, 0.75, 0.0010, 420, 18};
inline constexpr Bearing rear_bearing{20, 40, 67.5, 0.75, 0.0010, 220, 18};

// Built-in motor: nearly all of its loss goes into the jacket; this efficiency counts what reaches the spindle.
inline constexpr double motor_from_mm = 80.0;
inline constexpr double motor_to_mm = 180.0;
inline constexpr double motor_rated_power_W = 7500.0;
inline constexpr double motor_net_efficiency = 0.9965;

inline constexpr double film_W_m2K = 14.0;  // outer surface of the cartridge, all that it loses to the air

}  // namespace zerodrift::machine::nominal
