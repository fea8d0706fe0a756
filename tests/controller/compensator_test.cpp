// The host compensator against a small device.

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/controller/host_compensator.h"
#include "core/controller/upload.h"
#include "device.h"
#include "fixtures.h"

namespace zerodrift::controller {
namespace {

compensation::Table model() {
  compensation::Table table;
  table.axes["Z"].terms = {{"T1_C", 2.0, 20.0, 0.0}};
  table.axes["Z"].max_um_per_s = 1e6;
  table.valid["T1_C"] = {18.0, 30.0};
  return table;
}

/// The switch is on, T1 at 24 C, a turn takes 20 ms.
class HostCompensatorTest : public testing::Test {
 protected:
  HostCompensatorTest() {
    device.set(17, 1);
    device.set(100, 16 * 24);
    machine = open(device.profile());
    options.period_s = 0.02;
  }
  Result<CompensatorSummary> run(const std::function<void(const CompensatorTurn&)>& observer) {
    return run_host_compensator(*machine, model(), options, {stop.get_token(), {}}, observer);
  }

  Device device;
  std::unique_ptr<ModbusMachine> machine;
  std::stop_source stop;
  HostCompensatorOptions options;
};

}  // namespace

TEST_F(HostCompensatorTest, WritesThePredictionAndRunsToZero) {
  std::vector<CompensatorTurn> turns;
  int clock = 0;
  const auto summary = run([&](const CompensatorTurn& turn) {
    turns.push_back(turn);
    device.set(9, static_cast<std::uint16_t>(clock += 100));  // a machine second a turn
    if (turns.size() == 5) {
      EXPECT_NEAR(device.float_at(144), -8.0, 1e-6);
    }
    if (turns.size() == 10) device.set(100, 16 * 60);  // far outside the training
    if (turns.size() == 15) {
      EXPECT_EQ(turn.output.mode, compensation::FollowerMode::held_at_edge);
      EXPECT_NEAR(device.float_at(144), -22.0, 1e-6);  // held at 31 C: 30 and the margin
      device.set(100, 0x8000);                         // broken wire
    }
    if (turns.size() == 25) {
      EXPECT_EQ(turn.output.mode, compensation::FollowerMode::safe_zero);
      EXPECT_DOUBLE_EQ(device.float_at(144), 0.0);
      device.set(100, 16 * 22);
    }
    if (turns.size() == 30) {
      EXPECT_NEAR(device.float_at(144), -4.0, 1e-6);
      stop.request_stop();
    }
  });
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_GE(summary->turns, 30);
  EXPECT_DOUBLE_EQ(device.float_at(144), 0.0);
}

// It answers, but its heartbeat stands: nothing more is written, so that its watchdog can act; it beats again: on we
// go.
TEST_F(HostCompensatorTest, AControllerThatNoLongerBeatsIsNotWrittenTo) {
  options.silence_s = 0.1;
  int turns = 0;
  int lost = 0;
  std::uint16_t beat = 0;
  std::uint16_t at_silence = 0;
  bool again = false;
  const auto summary = run([&](const CompensatorTurn& turn) {
    ++turns;
    if (turns < 20 || turns > 60) device.set(10, ++beat);
    device.set(9, static_cast<std::uint16_t>(100 * turns));
    if (turn.link_lost && ++lost == 1) at_silence = device.word(11);
    if (turns == 60) {
      EXPECT_GT(lost, 20);
      EXPECT_EQ(device.word(11), at_silence) << "our heartbeat must stop too";
    }
    again = again || (turns > 60 && !turn.link_lost);
    if (turns == 80) stop.request_stop();
  });
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_TRUE(again);
  EXPECT_EQ(summary->lost_turns, lost);
}

TEST_F(HostCompensatorTest, IsInterlocked) {
  device.set(17, 0);
  EXPECT_EQ(run_host_compensator(*machine, model(), {}, {}).error().code, ErrorCode::interlock_compensation_off);
  ASSERT_TRUE(upload_table(*machine, model(), {}, {}).result);
  EXPECT_EQ(run_host_compensator(*machine, model(), {}, {}).error().code, ErrorCode::data_does_not_fit);
}

}  // namespace zerodrift::controller
