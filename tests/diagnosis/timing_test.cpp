// Inputs that switch between two samples: nobody knows when, and that is no missing physics.
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/inference/run.h"
#include "core/physics/builder.h"
#include "core/physics/prediction.h"
#include "tests/diagnosis/simulated.h"

namespace zerodrift::diagnosis {
namespace {

/// A thin bar that a motor warms in its middle, with a sensor at the motor's edge: it feels a minute's heat at once.
nlohmann::json bar_json() {
  return nlohmann::json::parse(R"({
    "format": "zerodrift-machine/1", "name": "bar", "initial_temperature_C": 20.0,
    "components": [{"id": "bar", "length_mm": 1500, "outer_diameter_mm": 24,
      "material": {"conductivity_W_mK": 118, "density_kg_m3": 8400, "heat_capacity_J_kgK": 385, "expansion_1_K": 1.9e-5},
      "heat_sources": [{"id": "motor", "kind": "motor", "from_mm": 700, "to_mm": 800, "rated_power_W": 600,
        "efficiency": 0.9, "rated_speed_rpm": 6000}]}],
    "effects": ["convection"], "effect_parameters": {"convection": {"h_W_m2K": 15}},
    "sensors": [{"channel": "T1_C", "component": "bar", "position_mm": 0, "accuracy_C": 0.2},
      {"channel": "T2_C", "component": "bar", "position_mm": 400, "accuracy_C": 0.2},
      {"channel": "T3_C", "component": "bar", "position_mm": 800, "accuracy_C": 0.2},
      {"channel": "T4_C", "component": "bar", "position_mm": 1200, "accuracy_C": 0.2},
      {"channel": "ambient_C", "component": "ambient"}],
    "displacements": [{"channel": "dZ_um", "direction": "Z", "component": "bar"}]})");
}

physics::Machine bar(double timing_sigma_s = 0.0) {
  nlohmann::json json = bar_json();
  if (timing_sigma_s > 0.0) json["input_timing_sigma_s"] = timing_sigma_s;
  return *physics::machine_from_json(json, "bar.json");
}

/// Speeds that change every hour at any moment, logged once a minute; what the bar then does, with noise.
recording::Recording logged_each_minute(unsigned seed) {
  constexpr double step_s = 5.0;
  constexpr std::size_t every = 12;
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  std::normal_distribution<double> noise(0.0, 1.0);
  recording::Recording fine;
  fine.name = "fine";
  recording::Channel rpm{"spindle_rpm", {}}, room{"ambient_C", {}};
  double speed = 0.0, next_s = 600.0 + 60.0 * share(random);
  for (double t = 0.0; t < 5.0 * 3600.0; t += step_s) {
    if (t >= next_s) {
      speed = speed > 0.0 && share(random) < 0.4 ? 0.0 : 1500.0 + 3500.0 * share(random);
      next_s += 2400.0 + 2400.0 * share(random);
    }
    fine.time_s.push_back(t);
    rpm.values.push_back(speed);
    room.values.push_back(20.0);
  }
  fine.channels = {rpm, room};
  const physics::Machine machine = bar();
  const physics::Network network = physics::build_network(machine, fine);
  std::vector<double> values = network.start_values();
  values[static_cast<std::size_t>(network.hold_parameter)] = 0.0;
  const physics::Prediction truth = physics::predict(network, physics::make_inputs(network, fine), values);
  for (std::size_t c = 0; c < network.observations.size(); ++c) {
    fine.channels.push_back({network.observations[c].channel, truth.channels[c].values});
  }
  recording::Recording logged;
  logged.name = "logged";
  for (const auto& channel : fine.channels) logged.channels.push_back({channel.name, {}});
  for (std::size_t k = 0; k < fine.rows(); k += every) {
    logged.time_s.push_back(fine.time_s[k]);
    for (std::size_t c = 0; c < fine.channels.size(); ++c) {
      const double width = c < 2 ? 0.0 : fine.channels[c].name[0] == 'd' ? 0.1 : 0.02;
      logged.channels[c].values.push_back(fine.channels[c].values[k] + width * noise(random));
    }
  }
  return logged;
}

/// The machine on for an hour and off again, a sample a minute.
inference::Run on_and_off(const physics::Machine& machine) {
  recording::Recording run;
  run.channels = {{"spindle_rpm", {}}, {"T3_C", {}}};
  for (int k = 0; k < 150; ++k) {
    run.time_s.push_back(60.0 * k);
    run.channels[0].values.push_back(k >= 30 && k < 90 ? 3000.0 : 0.0);
    run.channels[1].values.push_back(20.0);
  }
  const physics::Network network = physics::build_network(machine, run);
  return inference::make_run(std::move(run), network, DiagnosisSettings{});
}

std::vector<double> timing_at_the_motor(const inference::Run& run) {
  return std::find_if(run.series.begin(), run.series.end(), [](const auto& c) { return c.channel == "T3_C"; })->timing;
}

}  // namespace

TEST(Timing, WhatIsSwitchedOffIsAsUncertainAsWhatIsSwitchedOn) {
  const std::vector<double> variance = timing_at_the_motor(on_and_off(bar()));
  EXPECT_GT(variance[30], 100.0 * variance[60]);
  EXPECT_NEAR(variance[90] / variance[30], 1.0, 0.1);
}

TEST(Timing, AStatedTimingCounts) {
  const double usual = timing_at_the_motor(on_and_off(bar()))[30];
  const double known = timing_at_the_motor(on_and_off(bar(1.8)))[30];  // a tenth of 0.3 sample intervals
  EXPECT_NEAR(known / usual, 0.01, 1e-6);
}

/// A heat so strong beside its sensor that a minute of it is 20 K decays faster than the slow drift knows: that may
/// still be called unexplained, but it is no effect.
TEST(Timing, SwitchingBetweenSamplesIsNoMissingPhysics) {
  int unexplained = 0;
  for (unsigned seed = 1; seed <= 4; ++seed) {
    const auto answer = diagnosed_and_simulated(bar(), {logged_each_minute(seed)}, {false});
    ASSERT_TRUE(answer.has_value()) << describe(answer.error());
    EXPECT_NE(answer->verdict, Verdict::missing_effect) << seed;
    if (answer->verdict == Verdict::unexplained) ++unexplained;
  }
  EXPECT_LE(unexplained, 1);
}

}  // namespace zerodrift::diagnosis
