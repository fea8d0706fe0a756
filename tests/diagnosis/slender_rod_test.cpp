// A sound screw, whose narrow nut heats a few cells steeply: nothing is missing, whether the run starts at rest or in
// the middle of another. Recordings integrated here, apart from the program's own simulation.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "tests/diagnosis/answered.h"
#include "tests/diagnosis/simulated.h"

namespace zerodrift::diagnosis {
namespace {

using Json = nlohmann::json;

constexpr double hall_C = 21.0;
constexpr double nut_from_mm = 330.0;
constexpr double nut_to_mm = 370.0;
constexpr std::array sensors_mm = {50.0, 200.0, 300.0, 400.0, 550.0};

physics::Machine described() {
  Json machine = Json::parse(R"({"format": "zerodrift-machine/1", "name": "screw",
    "components": [{"id": "screw", "length_mm": 600, "outer_diameter_mm": 50,
      "material": {"conductivity_W_mK": 45, "density_kg_m3": 7800, "heat_capacity_J_kgK": 475,
        "expansion_1_K": 1.17e-5},
      "heat_sources": [{"id": "nut", "kind": "input", "channel": "load_W", "watts_per_unit": 1.05}]}],
    "effects": ["convection"], "effect_parameters": {"convection": {"h_W_m2K": 12}},
    "sensors": [{"channel": "ambient_C", "component": "ambient"}],
    "displacements": [{"channel": "dZ_um", "direction": "Z", "component": "screw"}]})");
  machine["components"][0]["heat_sources"][0]["from_mm"] = nut_from_mm;
  machine["components"][0]["heat_sources"][0]["to_mm"] = nut_to_mm;
  for (std::size_t i = 0; i < sensors_mm.size(); ++i) {
    machine["sensors"].push_back({{"channel", "T" + std::to_string(i + 1) + "_C"},
                                  {"component", "screw"},
                                  {"position_mm", sensors_mm[i]},
                                  {"accuracy_C", 0.1}});
  }
  return *physics::machine_from_json(machine, "machine.json");
}

/// The rod in 300 cells, stepped explicitly. It runs at 60 W for `before_s` until five minutes before the recording.
recording::Recording run_of(double before_s) {
  constexpr std::size_t cells = 300;
  constexpr double cell_m = 0.6 / cells;
  constexpr double conductivity_W_mK = 46.0;
  constexpr double capacity_J_m3K = 7800.0 * 480.0;
  constexpr double film_W_m2K = 11.0;
  constexpr double expansion_1_K = 1.15e-5;
  constexpr double section_m2 = std::numbers::pi * 0.05 * 0.05 / 4.0;
  constexpr double around_m = std::numbers::pi * 0.05;
  constexpr double period_s = 30.0;
  constexpr double last_s = 10800.0;
  const double step_s = period_s / std::ceil(period_s * conductivity_W_mK / (0.4 * capacity_J_m3K * cell_m * cell_m));
  const auto load_W = [&](double t_s) {
    if (t_s < 0.0) return t_s < -300.0 ? 60.0 : 0.0;
    return t_s >= 3600.0 && t_s < 7200.0 ? 60.0 : 0.0;
  };
  recording::Recording run;
  run.name = "run.csv";
  for (const char* name : {"load_W", "ambient_C", "T1_C", "T2_C", "T3_C", "T4_C", "T5_C", "dZ_um"})
    run.channels.push_back({name, {}});
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1.0);
  std::vector<double> state_C(cells, hall_C);
  std::vector<double> next_C = state_C;
  const auto steps_a_period = static_cast<long>(std::lround(period_s / step_s));
  double length_at_zero_um = 0.0;
  for (long i = -std::lround(before_s / step_s); static_cast<double>(i) * step_s <= last_s; ++i) {
    const double t_s = static_cast<double>(i) * step_s;
    if (i >= 0 && i % steps_a_period == 0) {
      double length_um = 0.0;
      for (const double value_C : state_C) length_um += 1e6 * expansion_1_K * cell_m * value_C;
      if (i == 0) length_at_zero_um = length_um;
      run.time_s.push_back(t_s);
      run.channels[0].values.push_back(load_W(t_s));
      run.channels[1].values.push_back(hall_C);
      for (std::size_t k = 0; k < sensors_mm.size(); ++k) {
        const auto right = static_cast<std::size_t>(sensors_mm[k] * 1e-3 / cell_m + 0.5);
        run.channels[2 + k].values.push_back(0.5 * (state_C[right - 1] + state_C[right]) + 0.05 * noise(random));
      }
      run.channels[7].values.push_back(length_um - length_at_zero_um + 0.3 * noise(random));
    }
    for (std::size_t c = 0; c < cells; ++c) {
      const double middle_mm = 1e3 * cell_m * (static_cast<double>(c) + 0.5);
      const bool heated = middle_mm > nut_from_mm && middle_mm < nut_to_mm;
      double heat_W = heated ? load_W(t_s) * 1e3 * cell_m / (nut_to_mm - nut_from_mm) : 0.0;
      heat_W -= film_W_m2K * around_m * cell_m * (state_C[c] - hall_C);
      if (c > 0) heat_W += conductivity_W_mK * section_m2 / cell_m * (state_C[c - 1] - state_C[c]);
      if (c + 1 < cells) heat_W += conductivity_W_mK * section_m2 / cell_m * (state_C[c + 1] - state_C[c]);
      next_C[c] = state_C[c] + step_s * heat_W / (capacity_J_m3K * section_m2 * cell_m);
    }
    std::swap(state_C, next_C);
  }
  return run;
}

}  // namespace

/// The nut ends between two faces of the cells. With a centre of its heat half a millimetre off, a sound screw had a
/// joint at 0.99.
TEST(SlenderRod, ASteepSourceThatEndsBetweenFacesIsNoJoint) {
  const auto answer = diagnosed_and_simulated(described(), {run_of(0.0)});
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_EQ(answer->verdict, Verdict::consistent);
}

/// 48 K above its room, steep at the nut where no sensor is: that is left of what ran before.
TEST(SlenderRod, WhatRanBeforeIsMadeOfTheSourcesThatRan) {
  const recording::Recording run = run_of(9000.0);
  EXPECT_GT(run.find("T3_C")->values.front(), hall_C + 40.0);
  const auto answer = diagnosed_and_simulated(described(), {run});
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_EQ(answer->verdict, Verdict::consistent);
  EXPECT_TRUE(notes(*answer, "warm_start:screw"));
}

}  // namespace zerodrift::diagnosis
