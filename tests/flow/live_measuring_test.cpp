#include "core/flow/live_measuring.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <thread>

namespace zerodrift::flow {
namespace {

using acquisition::ErrorSample;

/// What the target does, whatever the machine compensates: settable from the test's thread.
class ScriptedErrors : public acquisition::ErrorSource {
 public:
  explicit ScriptedErrors(std::atomic<double>& error_um) : m_error_um(error_um) {}
  Status take_zero(const acquisition::Stand&, const TaskContext&) override { return {}; }
  Result<ErrorSample> measure(const acquisition::Stand&, const TaskContext&) override {
    return ErrorSample{{m_error_um.load(), 0.0, 0.0}, {0.1, 0.1, 0.1}, {}};
  }
  std::string name() const override { return "scripted"; }

 private:
  std::atomic<double>& m_error_um;
};

class LiveMeasuringTest : public testing::Test {
 protected:
  LiveMeasuringTest() {
    LiveMeasuringOptions options;
    options.position_mm = {{"X", 0.0}};
    options.every_s = 0.002;
    options.drift.um_per_min = 5.0;
    measuring.emplace(std::make_unique<ScriptedErrors>(error_um), options);
    turn.axes = {{"X", 0.0}};
  }

  /// The next measurement that was begun after this call; nothing within five seconds.
  std::optional<LiveMeasuring::Now> next() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
    int seen = 0;
    while (std::chrono::steady_clock::now() < end) {
      turn.machine_time_s += 0.001;
      auto now = measuring->exchange(turn);
      if (now.left && ++seen == 2) return now;  // the first may have begun before
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return std::nullopt;
  }

  std::atomic<double> error_um = 1.0;
  std::optional<LiveMeasuring> measuring;
  controller::CompensatorTurn turn;
};

TEST_F(LiveMeasuringTest, MeasuresWhatIsLeftWhereTheMachineStands) {
  const auto now = next();
  ASSERT_TRUE(now);
  EXPECT_EQ(now->left->error_um[0], 1.0);
  EXPECT_EQ(now->not_measured, "");
  turn.axes = {{"X", 5.0}};
  measuring->exchange(turn);
  EXPECT_EQ(measuring->exchange(turn).not_measured, "the machine is not at the measuring position");
}

TEST_F(LiveMeasuringTest, ALeapThatHeatCannotMakeIsRefusedAndNamedUntilItStays) {
  ASSERT_TRUE(next());
  error_um = 40.0;
  int refused = 0;
  std::optional<LiveMeasuring::Now> now;
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(5);
  while (std::chrono::steady_clock::now() < end) {
    now = measuring->exchange(turn);
    if (!now->left) continue;
    if (now->left->error_um[0] == 40.0) break;
    if (!std::isnan(now->left->error_um[0])) continue;  // of before
    ++refused;
    EXPECT_NE(now->not_measured.find("error_leapt"), std::string::npos) << now->not_measured;
    EXPECT_NE(now->not_measured.find("+39.0"), std::string::npos) << now->not_measured;
  }
  EXPECT_LE(refused, 2) << "the third that agrees counts";
  EXPECT_GE(refused, 1);
  ASSERT_TRUE(now && now->left);
  EXPECT_EQ(now->left->error_um[0], 40.0);
}

TEST_F(LiveMeasuringTest, WhatIsCompensatedIsNoLeap) {
  ASSERT_TRUE(next());
  error_um = -39.0;
  turn.applied_um = {-40.0, 0.0, 0.0};
  // The measurement under way may have begun before: its middle is neither.
  std::optional<LiveMeasuring::Now> now;
  for (int k = 0; k < 5; ++k) now = next();
  ASSERT_TRUE(now);
  EXPECT_EQ(now->left->error_um[0], -39.0);
  EXPECT_EQ(now->not_measured, "");
}

TEST(LiveMeasuring, WithoutASourceSaysWhy) {
  LiveMeasuring measuring(fail(ErrorCode::step_blocked, {{"step", "compensator"}, {"needs", "warmup"}}), {});
  EXPECT_NE(measuring.exchange({}).not_measured.find("warmup"), std::string::npos);
}

}  // namespace
}  // namespace zerodrift::flow
