#include <gtest/gtest.h>

#include <cmath>

#include "app/machine/sensors.h"
#include "app/machine/thermal_model.h"
#include "app/machine/thermal_network.h"

namespace zerodrift::machine {
namespace {

TEST(ThermalNetwork, ALumpCoolsByNewtonsLaw) {
  ThermalNetwork network;
  const int lump = network.add_node(1000.0);
  network.add_boundary_link(lump, network.add_boundary(20.0), 2.0);
  network.start(60.0);
  for (int i = 0; i < 1000; ++i) network.step(0.5);
  // implicit Euler is first order: half a step of lag
  EXPECT_NEAR(network.temperature_C(lump), 20.0 + 40.0 * std::exp(-500.0 / 500.0), 0.01);
}

TEST(ThermalNetwork, SteadyStateIsThatOfTheConductances) {
  ThermalNetwork network;
  const int hot = network.add_node(10.0);
  const int cold = network.add_node(10.0);
  network.add_link(hot, cold, 4.0);
  network.add_boundary_link(cold, network.add_boundary(20.0), 2.0);
  network.start(20.0);
  for (int i = 0; i < 1000; ++i) {
    network.add_heat(hot, 8.0);
    network.step(10.0);
  }
  EXPECT_NEAR(network.temperature_C(cold), 24.0, 1e-9);
  EXPECT_NEAR(network.temperature_C(hot), 26.0, 1e-9);
}

MachineInputs running(double rpm) {
  return {rpm, true, 0.0, {2400, 1620, 1200}, true};
}

void run(ThermalModel& model, double hours, const MachineInputs& inputs) {
  const auto steps = static_cast<int>(hours * 3600.0 / ThermalModel::step_s);
  for (int i = 0; i < steps; ++i) model.step(inputs);
}

TEST(ThermalModel, StoresExactlyTheHeatThatFlowsIn) {
  ThermalModel model(build_machine(1));
  double in_J = 0.0;
  const double before_J = model.network().energy_J();
  for (int i = 0; i < 3600; ++i) {
    model.step(running(i < 1800 ? 6000 : 0));
    in_J += model.network().last_input_J();
  }
  EXPECT_GT(in_J, 1e4);
  EXPECT_NEAR(model.network().energy_J() - before_J, in_J, 1e-7 * model.network().energy_J());
}

/// The motor warms the spindle behind 180 mm, and what a joint keeps from the nose stays there.
TEST(ThermalModel, AJointIsAPlaneAndASensorReadsItsOwnSide) {
  const auto between_bearing_and_motor_C = [](double joint_mm) {
    HiddenEffect joint = *draw_effect("contact_resistance", 1);
    joint.size = 0.02;
    joint.position_mm = joint_mm;
    ThermalModel model(build_machine(1, joint));
    double in_J = 0.0;
    const double before_J = model.network().energy_J();
    for (int i = 0; i < 7200; ++i) {
      model.step(running(6000));
      in_J += model.network().last_input_J();
    }
    EXPECT_NEAR(model.network().energy_J() - before_J, in_J, 1e-7 * model.network().energy_J());
    return model.sensor_C()[1];  // at 260 mm
  };
  const double behind_C = between_bearing_and_motor_C(259.0), before_C = between_bearing_and_motor_C(261.0);
  EXPECT_GT(std::abs(behind_C - before_C), 2.0);
  EXPECT_NEAR(between_bearing_and_motor_C(255.0), behind_C, 0.2 * std::abs(behind_C - before_C));
  EXPECT_NEAR(between_bearing_and_motor_C(265.0), before_C, 0.2 * std::abs(behind_C - before_C));
}

TEST(ThermalModel, IsAsLargeAsARealMachine) {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    ThermalModel model(build_machine(seed));
    run(model, 4.0, running(3000));
    const NoseErrors& errors = model.errors();
    EXPECT_GT(errors.um[2], 40.0) << seed;
    EXPECT_LT(errors.um[2], 80.0) << seed;
    EXPECT_GT(std::abs(errors.um[0]), 10.0) << seed;
    EXPECT_LT(std::abs(errors.um[0]), 35.0) << seed;
    EXPECT_GT(std::abs(errors.um[1]), 7.0) << seed;
    EXPECT_LT(std::abs(errors.um[1]), 30.0) << seed;
    EXPECT_GT(std::abs(errors.urad[0]), 1.0) << seed;
    EXPECT_LT(model.sensor_C()[0], 45.0) << seed;
  }
}

TEST(ThermalModel, ErrorsHaveSeveralSignsAndTimeConstants) {
  ThermalModel model(build_machine(3));
  run(model, 0.5, running(3000));
  const auto early = model.errors().um;
  run(model, 3.5, running(3000));
  const auto late = model.errors().um;
  EXPECT_LT(late[0] * late[1], 0.0);
  // X, driven by the screw, is farther along after half an hour than Z, driven by the spindle's body
  EXPECT_GT(early[0] / late[0], early[2] / late[2] + 0.03);
}

TEST(ThermalModel, CoolsDownWhenEverythingStops) {
  ThermalModel model(build_machine(2));
  run(model, 3.0, running(6000));
  const double hot = model.spindle_growth_um();
  run(model, 12.0, {});
  EXPECT_LT(model.spindle_growth_um(), 0.1 * hot);
}

TEST(ThermalModel, SameSeedSameMachineOtherSeedAnother) {
  const auto z_after = [](std::uint64_t seed) {
    ThermalModel model(build_machine(seed));
    run(model, 1.0, running(3000));
    return model.errors().um[2];
  };
  EXPECT_EQ(z_after(5), z_after(5));
  EXPECT_GT(std::abs(z_after(5) - z_after(6)), 0.1);
}

TEST(ThermalModel, EveryHiddenEffectShows) {
  const auto history = [](const HiddenEffect& hidden) {
    ThermalModel model(build_machine(4, hidden));
    const SensorBoard board(build_machine(4, hidden));
    std::vector<double> seen;
    for (int minute = 0; minute < 240; ++minute) {
      const double rpm = minute < 60 ? 3000 : minute < 100 ? 6000 : minute < 150 ? 0 : 4500;
      for (int i = 0; i < 30; ++i) model.step({rpm, minute % 40 < 20, minute % 60 < 30 ? 900.0 : 0.0, {}, false});
      for (int s = 0; s < 5; ++s) {
        seen.push_back(board.reading(s + 1, model.sensor_C()[s], static_cast<std::uint64_t>(minute)) / 16.0);
      }
      for (const double um : model.nose_against_head_um()) seen.push_back(um / 5.0);  // 5 um weigh as 1 K
    }
    return seen;
  };
  const auto plain = history({});
  for (const ConcealableEffect& effect : concealable_effects()) {
    if (effect.id == "convection") continue;  // in the truth always; hidden, the description lacks it
    const auto hidden = history(*draw_effect(std::string(effect.id), 4));
    double largest = 0.0;
    for (std::size_t i = 0; i < plain.size(); ++i) largest = std::max(largest, std::abs(plain[i] - hidden[i]));
    EXPECT_GT(largest, 0.45) << effect.id;
  }
}

TEST(HiddenEffect, DrawsWithinItsTableAndCommits) {
  for (const ConcealableEffect& effect : concealable_effects()) {
    for (unsigned long long seed = 1; seed < 20; ++seed) {
      const auto drawn = draw_effect(std::string(effect.id), seed);
      ASSERT_TRUE(drawn);
      EXPECT_GE(std::abs(drawn->size), effect.low);
      EXPECT_LE(std::abs(drawn->size), effect.high);
    }
  }
  EXPECT_FALSE(draw_effect("gremlins", 1));
  EXPECT_TRUE(draw_effect("none", 1)->id.empty());
  const Commitment first = commit_to(*draw_effect("random", 3));
  EXPECT_EQ(first.sha256.size(), 64U);
  EXPECT_NE(first.sha256, commit_to(*draw_effect("random", 3)).sha256) << "the salt must be new each time";
}

TEST(SensorBoard, HasTheNoiseAndStepsOfItsDataSheet) {
  const MachineParameters built = build_machine(9);
  const SensorBoard board(built);
  double sum = 0.0;
  double squares = 0.0;
  const int count = 20000;
  for (int i = 0; i < count; ++i) {
    const double error = board.reading(1, 25.03, static_cast<std::uint64_t>(i)) / 16.0 - 25.03;
    sum += error;
    squares += error * error;
  }
  const double mean = sum / count;
  EXPECT_NEAR(mean, built.sensor_offset_K[0], 0.004);
  EXPECT_NEAR(std::sqrt(squares / count - mean * mean), std::hypot(0.1, 0.0625 / std::sqrt(12.0)), 0.003);
  EXPECT_EQ(board.reading(4, 30.0, 17), board.reading(4, 30.0, 17));
}

}  // namespace
}  // namespace zerodrift::machine
