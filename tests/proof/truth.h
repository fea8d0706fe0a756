#pragma once
// The machine as it really is, hidden effects included, and its runs: what the proof draws and the diagnosis never
// sees.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/noise.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::proof {

struct Bearing {
  double from, to, dm, f0, f1, load, nu;  // m, m, mm, 1, 1, N, mm2/s
};

struct Truth {
  double length, outer, bore;  // m, diameters
  double k, rho, c, alpha;
  double motor_from, motor_to, motor_W, efficiency, rated_rpm;
  std::vector<Bearing> bearings;
  double h;
  std::vector<double> sensors;  // m
  double start_C;
  std::vector<double> scale;  // motor, bearings
  double end_h = 0;
  // hidden
  double speed_a = 0, speed_m = 0.7, eps = 0, cool_h = 0, cool_from = 0, cool_to = 0, cool_C = 20;
  double beta = 0, preload_T = 0, preload_n = 0, preload_0 = 0;
  double extra_W = 0, extra_x = 0, contact_R = 0, contact_x = 0, cut_share = 0;
  int extra_law = 0;
  double ambient_g = 0, ambient_tau = 4000, bend_g = 0, bend_tau = 2000;
  int bend_driver = 0;
  int lag_channel = -1, offset_channel = -1;
  double lag_s = 0, offset_K = 0;
  double draught_h = 0, draught_from_s = 0, draught_to_s = 0;  // grows towards the nose
  double wander_W = 0, wander_x = 0, creep_um = 0, backlash_um = 0, stick_um = 0;
  double travel_W = 0, travel_from = 0, travel_to = 0, travel_s = 1;
  std::uint64_t wander_seed = 0;
};

struct Schedule {
  std::vector<double> time, rpm, coolant, load, room;
};

struct Readings {
  std::vector<std::vector<double>> temperatures;  // [sensor][row]
  std::vector<double> dz, dy;
  double coolant_W = 0;  // that it brings while it flows, on average; less than nothing
};

Truth draw_machine(Noise& noise);
/// The real machine differs from its description by the tolerances.
void perturb(Truth& m, Noise& noise);
/// The description that the user has.
nlohmann::json describe(const Truth& m, bool with_convection);
Schedule make_schedule(Noise& noise, const Truth& m, bool poor);
/// What the machine would show without any noise.
Readings run(const Truth& m, const Schedule& s);

/// Ids that can be hidden.
const std::vector<std::string>& listed();
/// Hides an effect of plausible size times `strength`; a shape drawn once stays under rescale().
HiddenEffect hide(Truth& m, const std::string& id, Noise& noise, double strength);
/// Multiplies the size of one hidden effect.
void rescale(Truth& m, const std::string& id, double factor);

}  // namespace zerodrift::proof
