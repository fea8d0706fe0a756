#include "core/acquisition/health.h"

#include <gtest/gtest.h>

#include "fake_machine.h"

namespace zerodrift::acquisition {
namespace {

TEST(Health, OfAGoodMachine) {
  ManualClock clock;
  FakeMachine machine(clock, 20);
  const auto health = machine_health(machine, clock, {}, {});
  ASSERT_TRUE(health) << describe(health.error());
  EXPECT_EQ(health->sensors_alive, 20);
  EXPECT_TRUE(health->obstacles.empty());
  EXPECT_NEAR(health->spread_K, 0.0, 0.15);
  EXPECT_NEAR(*health->sensors[0].noise_C, 0.1, 0.06);
  EXPECT_NEAR(*health->sensors[0].value_C, 20.0, 0.1);
  EXPECT_NEAR(health->clock_difference_s, 0.0, 1e-9);
  EXPECT_GT(health->observed_s, 3.0);
  EXPECT_TRUE(machine.commands.empty());
}

TEST(Health, NamesBadSensorsAndObstacles) {
  ManualClock clock;
  FakeMachine machine(clock, 20);
  machine.change = [](MachineSample& sample) {
    sample.temperature_C[2] = std::nan("");
    sample.temperature_C[4] = 21.5;
    sample.temperature_C[6] += 400.0;
    sample.compensation_on = true;
    sample.referenced = false;
  };
  const auto health = machine_health(machine, clock, {}, {});
  ASSERT_TRUE(health);
  EXPECT_EQ(health->sensors[2].state, SensorState::dead);
  EXPECT_FALSE(health->sensors[2].value_C);
  EXPECT_EQ(health->sensors[4].state, SensorState::stuck);
  EXPECT_EQ(health->sensors[6].state, SensorState::out_of_range);
  EXPECT_EQ(health->sensors_alive, 17);
  EXPECT_LT(health->spread_K, 0.2);  // of those that are ok: the one that stands at 21.5 does not count
  EXPECT_EQ(health->spread_K, spread_of(health->sensors));
  ASSERT_EQ(health->obstacles.size(), 2u);
  EXPECT_EQ(health->obstacles[0].code, ErrorCode::interlock_compensation_on);
  EXPECT_EQ(health->obstacles[1].code, ErrorCode::machine_not_ready);
}

TEST(Health, TheSpreadIsOfMeansAndOfSensorsThatLive) {
  const double none = std::nan("");
  const auto sensors = judged({}, {{20.0, 20.2}, {21.0, 21.4}, {19.0, none}, {350.0, 350.0}});
  EXPECT_EQ(sensors[2].state, SensorState::dead);
  EXPECT_EQ(sensors[3].state, SensorState::out_of_range);
  EXPECT_NEAR(spread_of(sensors), 21.2 - 20.1, 1e-12);
  EXPECT_EQ(spread_of({}), 0.0);
}

TEST(Health, SeesAClockThatRunsFast) {
  ManualClock clock;
  FakeMachine machine(clock);
  machine.change = [](MachineSample& sample) { sample.machine_time_s *= 1.01; };
  const auto health = machine_health(machine, clock, {}, {});
  ASSERT_TRUE(health);
  EXPECT_NEAR(health->clock_difference_s, 0.038, 0.001);
}

TEST(Health, OfNoMachine) {
  ManualClock clock;
  FakeMachine machine(clock);
  machine.cable_is_out = [](double) { return true; };
  const auto health = machine_health(machine, clock, {}, {});
  ASSERT_FALSE(health);
  EXPECT_EQ(health.error().code, ErrorCode::machine_link_lost);
}

}  // namespace
}  // namespace zerodrift::acquisition
