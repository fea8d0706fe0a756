#pragma once
// Machines and runs for the tests.

#include <nlohmann/json.hpp>

#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::physics::test {

/// The contract's spindle.
inline nlohmann::json spindle_json() {
  return nlohmann::json::parse(R"({
    "format": "zerodrift-machine/1", "name": "VMC-850 #3", "initial_temperature_C": 20.0,
    "components": [{"id": "spindle", "length_mm": 400, "outer_diameter_mm": 70, "bore_diameter_mm": 20,
      "material": {"conductivity_W_mK": 44, "density_kg_m3": 7850, "heat_capacity_J_kgK": 460, "expansion_1_K": 1.15e-5},
      "heat_sources": [
        {"id": "motor", "kind": "motor", "from_mm": 60, "to_mm": 160, "rated_power_W": 5500, "efficiency": 0.9,
         "rated_speed_rpm": 8000},
        {"id": "front_bearing", "kind": "bearing", "from_mm": 330, "to_mm": 355, "mean_diameter_mm": 85, "f0": 2,
         "f1": 0.001, "load_N": 900, "oil_viscosity_mm2_s": 32}]}],
    "effects": ["convection"], "effect_parameters": {"convection": {"h_W_m2K": 12}},
    "sensors": [{"channel": "T1_C", "component": "spindle", "position_mm": 20, "accuracy_C": 0.1},
      {"channel": "T2_C", "component": "spindle", "position_mm": 110, "accuracy_C": 0.1},
      {"channel": "T3_C", "component": "spindle", "position_mm": 200, "accuracy_C": 0.1},
      {"channel": "T4_C", "component": "spindle", "position_mm": 280, "accuracy_C": 0.1},
      {"channel": "T5_C", "component": "spindle", "position_mm": 343, "accuracy_C": 0.1},
      {"channel": "T6_C", "component": "spindle", "position_mm": 390, "accuracy_C": 0.1},
      {"channel": "ambient_C", "component": "ambient"}],
    "displacements": [{"channel": "dZ_um", "direction": "Z", "component": "spindle"},
      {"channel": "dY_um", "direction": "Y", "component": "spindle"}]})");
}

inline Machine spindle() {
  return *machine_from_json(spindle_json(), "spindle.json");
}

/// Stepped speeds with a stop, coolant and cutting load, room slowly rising.
inline recording::Recording stepped_run(double hours = 4.0, double period_s = 30.0) {
  recording::Recording r;
  r.name = "stepped";
  recording::Channel rpm{"spindle_rpm", {}}, coolant{"coolant_on", {}}, load{"spindle_load_W", {}},
      room{"ambient_C", {}};
  for (double t = 0.0; t <= hours * 3600.0 + 1e-9; t += period_s) {
    const double h = t / 3600.0;
    r.time_s.push_back(t);
    rpm.values.push_back(h < 0.1 ? 0.0 : h < 1.2 ? 3000.0 : h < 2.2 ? 7000.0 : h < 2.8 ? 0.0 : 5000.0);
    coolant.values.push_back(h > 1.6 && h < 2.6 ? 1.0 : 0.0);
    load.values.push_back(h > 0.5 && h < 0.9 ? 2000.0 : 0.0);
    room.values.push_back(20.0 + 0.4 * h);
  }
  r.channels = {rpm, coolant, load, room};
  return r;
}

}  // namespace zerodrift::physics::test
