#pragma once
// A rod with a heater at its fixed end, in a film, and what it shows: simulated by the program itself, with white
// noise.

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {

inline constexpr double white_K = 0.03;

/// A rod with a heater at its fixed end, in a film; `effects` and `parameters` as JSON.
inline physics::Machine rod(const std::string& effects, const std::string& parameters) {
  const std::string text = R"({"format": "zerodrift-machine/1", "initial_temperature_C": 20, "components": [
      {"id": "rod", "length_mm": 300, "outer_diameter_mm": 20, "bore_diameter_mm": 0,
       "material": {"conductivity_W_mK": 180, "density_kg_m3": 2700, "heat_capacity_J_kgK": 900, "expansion_1_K": 2.3e-5},
       "heat_sources": [{"id": "heater", "kind": "input", "channel": "heater_on", "from_mm": 0, "to_mm": 6,
                         "watts_per_unit": 8}]}],
      "effects": )" + effects +
                           R"(, "effect_parameters": )" + parameters + R"(,
      "sensors": [{"channel": "T1_C", "component": "rod", "position_mm": 10},
                  {"channel": "T2_C", "component": "rod", "position_mm": 150},
                  {"channel": "T3_C", "component": "rod", "position_mm": 290},
                  {"channel": "ambient_C", "component": "ambient"}],
      "displacements": []})";
  const auto machine = physics::machine_from_json(nlohmann::json::parse(text), "rod.json");
  EXPECT_TRUE(machine.has_value());
  return *machine;
}

/// `on_s`: when the heater is on.
inline recording::Recording inputs(double hours, const std::vector<std::pair<double, double>>& on_s) {
  recording::Recording run;
  run.name = "r1.csv";
  for (double t = 0.0; t <= hours * 3600.0; t += 20.0) run.time_s.push_back(t);
  run.channels = {{"heater_on", {}}, {"ambient_C", {}}};
  for (const double t : run.time_s) {
    const bool on = std::any_of(on_s.begin(), on_s.end(), [&](auto& one) { return t >= one.first && t < one.second; });
    run.channels[0].values.push_back(on ? 1.0 : 0.0);
    run.channels[1].values.push_back(20.0);
  }
  return run;
}

/// What a machine shows, with white noise.
inline recording::Recording measured(const physics::Machine& truth, recording::Recording run, unsigned seed) {
  const auto shown = physics::simulate(truth, run);
  EXPECT_TRUE(shown.has_value());
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, white_K);
  for (const char* channel : {"T1_C", "T2_C", "T3_C"}) {
    run.channels.push_back(*shown->prediction.find(channel));
    for (double& v : run.channels.back().values) v += noise(random);
  }
  return run;
}

inline const std::vector<std::pair<double, double>> on_and_off{{600.0, 5400.0}};

}  // namespace zerodrift::diagnosis
