// Descriptions of lumps alone, a sensor each: recordings integrated here, apart from the program's own simulation.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "core/diagnosis/diagnosis.h"
#include "tests/diagnosis/answered.h"

namespace zerodrift::diagnosis {
namespace {

recording::Recording empty_run(double hours, double period_s, const std::vector<std::string>& channels) {
  recording::Recording run;
  run.name = "run.csv";
  for (double t_s = 0.0; t_s <= hours * 3600.0; t_s += period_s) run.time_s.push_back(t_s);
  for (const auto& channel : channels) run.channels.push_back({channel, std::vector<double>(run.rows(), 0.0)});
  return run;
}

/// dT/dt = rate, in steps of 5 s; the state's first values are given.
void integrate(recording::Recording& run, std::vector<double> state,
               const std::function<std::vector<double>(double time_s, const std::vector<double>& state)>& rate,
               const std::function<void(std::size_t row, const std::vector<double>& state)>& write) {
  for (std::size_t k = 0; k < run.rows(); ++k) {
    for (double t_s = k == 0 ? 0.0 : run.time_s[k - 1]; t_s < run.time_s[k]; t_s += 5.0) {
      const std::vector<double> by_s = rate(t_s, state);
      for (std::size_t i = 0; i < state.size(); ++i) state[i] += 5.0 * by_s[i];
    }
    write(k, state);
  }
}

double room_C(double time_s) {
  const double day = 2.0 * 3.14159265 * time_s / 86400.0;
  return 22.0 - 1.5 * std::sin(day) + 0.5 * std::sin(3.7 * day);
}

/// Two hours on, two off, at other speeds in turn.
double speed_rpm(double time_s) {
  constexpr std::array speeds = {1000.0, 2000.0, 4000.0, 3000.0};
  const double hours = time_s / 3600.0;
  return std::fmod(hours, 4.0) < 2.0 ? speeds[static_cast<std::size_t>(hours / 4.0) % 4] : 0.0;
}

/// A part heated by the spindle's turning, W by speed, that exchanges heat with the room or what follows it late.
recording::Recording part_run(double room_lag_s, const std::function<double(double rpm)>& heat_K_s) {
  recording::Recording run = empty_run(32.0, 120.0, {"spindle_rpm", "room_C", "T1_C"});
  std::mt19937 random(4);
  std::normal_distribution<double> noise_K(0.0, 0.01);
  const auto rate = [&](double t_s, const std::vector<double>& state) -> std::vector<double> {
    const double around_C = room_lag_s > 0.0 ? state[1] : room_C(t_s);
    return {heat_K_s(speed_rpm(t_s)) - (state[0] - around_C) / 5400.0,
            room_lag_s > 0.0 ? (room_C(t_s) - state[1]) / room_lag_s : 0.0};
  };
  integrate(run, {22.0, 22.0}, rate, [&](std::size_t k, const std::vector<double>& state) {
    run.channels[0].values[k] = speed_rpm(run.time_s[k]);
    run.channels[1].values[k] = room_C(run.time_s[k]) + noise_K(random);
    run.channels[2].values[k] = state[0] + noise_K(random);
  });
  return run;
}

Diagnosis of_part(const recording::Recording& run) {
  const auto machine = physics::machine_from_json(nlohmann::json::parse(R"({"format": "zerodrift-machine/1",
    "components": [{"id": "part", "kind": "lump", "heat_sources": [
      {"id": "turning", "kind": "speed", "channel": "spindle_rpm", "law": ["on", "n", "n2"], "power_unknown": true}]}],
    "sensors": [{"channel": "T1_C", "component": "part", "accuracy_C": 0.1},
                {"channel": "room_C", "component": "ambient"}],
    "room": {"channel": "room_C"}})"),
                                                  "part.json");
  EXPECT_TRUE(machine.has_value());
  auto result = diagnosed_and_simulated(*machine, {run}, {false});
  EXPECT_TRUE(result.has_value());
  return result ? *result : Diagnosis{};
}

double heat_with_speed(double rpm) {
  return 4e-4 * rpm / 1000.0;
}

}  // namespace

TEST(Lumps, FeelTheRoomAtOnce) {
  const Diagnosis d = of_part(part_run(0.0, heat_with_speed));
  EXPECT_EQ(d.verdict, Verdict::missing_effect);
  ASSERT_EQ(d.effects.size(), 1U);
  EXPECT_EQ(d.effects[0].id, "convection");
  EXPECT_EQ(d.effects[0].parameters.count("room_lag_s"), 0U);
}

TEST(Lumps, FeelTheRoomLate) {
  const Diagnosis d = of_part(part_run(9000.0, heat_with_speed));
  EXPECT_EQ(d.verdict, Verdict::missing_effect);
  ASSERT_EQ(d.effects.size(), 1U);
  EXPECT_EQ(d.effects[0].id, "convection");
  ASSERT_EQ(d.effects[0].parameters.count("room_lag_s"), 1U);
  EXPECT_NEAR(d.effects[0].parameters.at("room_lag_s"), 9000.0, 2500.0);
}

/// Every law of the library rises with speed: heat that falls is not explained by what stands in for it.
TEST(Lumps, HeatThatFallsWithSpeedIsUnexplained) {
  const auto falling = [](double rpm) { return rpm == 0.0 ? 0.0 : 2e-3 - 4e-4 * rpm / 1000.0; };
  const Diagnosis d = of_part(part_run(0.0, falling));
  EXPECT_EQ(d.verdict, Verdict::unexplained);
  // The part does lose heat to the room; beside that only what nothing logged drives may be told.
  for (const FoundEffect& found : d.effects) EXPECT_TRUE(found.id == "convection" || found.id == "switched_heat");
}

/// A heat that comes and goes as it likes, into a part whose capacity is described: where, and how many watts.
TEST(Lumps, WhatIsMissingIsToldInWatts) {
  constexpr double capacity_J_K = 5000.0, film_W_K = 1.0;
  recording::Recording run = empty_run(32.0, 120.0, {"spindle_rpm", "room_C", "T1_C", "T2_C"});
  std::mt19937 random(7);
  std::normal_distribution<double> noise_K(0.0, 0.02);
  double sum_W = 0.0, sum_W2 = 0.0;
  const auto heat_W = [](double hours) { return 3.0 + 2.5 * std::sin(hours) + 1.5 * std::sin(2.3 * hours + 1.0); };
  integrate(
      run, {22.0, 22.0},
      [&](double t_s, const std::vector<double>& state) -> std::vector<double> {
        return {(heat_W(t_s / 3600.0) - film_W_K * (state[0] - 22.0)) / capacity_J_K,
                (4.0 * (speed_rpm(t_s) > 0.0) - film_W_K * (state[1] - 22.0)) / capacity_J_K};
      },
      [&](std::size_t k, const std::vector<double>& state) {
        run.channels[0].values[k] = speed_rpm(run.time_s[k]);
        run.channels[1].values[k] = 22.0;
        run.channels[2].values[k] = state[0] + noise_K(random);
        run.channels[3].values[k] = state[1] + noise_K(random);
        sum_W += std::abs(heat_W(run.time_s[k] / 3600.0));
        sum_W2 += std::pow(heat_W(run.time_s[k] / 3600.0), 2);
      });
  const auto machine = physics::machine_from_json(nlohmann::json::parse(R"({"format": "zerodrift-machine/1",
    "components": [{"id": "tank", "kind": "lump", "heat_capacity_J_K": 5000, "area_mm2": 100000},
                   {"id": "head", "kind": "lump", "heat_capacity_J_K": 5000, "area_mm2": 100000, "heat_sources": [
      {"id": "turning", "kind": "speed", "channel": "spindle_rpm", "law": ["on"], "power_unknown": true}]}],
    "sensors": [{"channel": "T1_C", "component": "tank", "accuracy_C": 0.1},
                {"channel": "T2_C", "component": "head", "accuracy_C": 0.1},
                {"channel": "room_C", "component": "ambient"}],
    "effects": ["convection"], "effect_parameters": {"convection": {"h_W_m2K": 10}},
    "room": {"channel": "room_C"}})"),
                                                  "tank.json");
  ASSERT_TRUE(machine.has_value());
  const auto d = diagnosed_and_simulated(*machine, {run});
  ASSERT_TRUE(d.has_value());
  EXPECT_NE(d->verdict, Verdict::consistent);
  ASSERT_FALSE(d->mismatch.channels.empty());
  EXPECT_EQ(d->mismatch.channels.front(), "T1_C");
  EXPECT_EQ(d->mismatch.component, "tank");
  EXPECT_FALSE(d->mismatch.position_mm.has_value());
  EXPECT_FALSE(d->mismatch.regime.empty());
  const double mean_W = sum_W2 / sum_W;  // over time, weighted by its size
  EXPECT_NEAR(d->mismatch.missing_heat_W, mean_W, 0.15 * mean_W);
}

/// A law that the description lacks, but a rising one.
TEST(Lumps, HeatThatRisesLessAndLessIsNotCalledFalling) {
  const auto saturating = [](double rpm) { return 2e-3 * std::tanh(rpm / 1500.0); };
  const Diagnosis d = of_part(part_run(0.0, saturating));
  EXPECT_EQ(d.verdict, Verdict::missing_effect);
  EXPECT_FALSE(d.effects.empty());
}

}  // namespace zerodrift::diagnosis
