// The host compensator against a small device.

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <random>
#include <stdexcept>

#include "core/controller/host_compensator.h"
#include "core/controller/offset_exit.h"
#include "core/controller/upload.h"
#include "fake_controller.h"
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

  /// Runs, and `act` is called at the turn by which the offset is in the machine.
  Result<CompensatorSummary> run_until(const std::function<void()>& act) {
    int turns = 0;
    return run([&, acted = false](const CompensatorTurn&) mutable {
      device.set(9, static_cast<std::uint16_t>(100 * ++turns));  // a machine second a turn
      if (acted || device.float_at(144) > -7.9) return;
      acted = true;
      act();
    });
  }
  std::array<double, 3> held() const { return {device.float_at(140), device.float_at(142), device.float_at(144)}; }
  void expect_as_found(bool switch_on) const {
    EXPECT_TRUE(is_zero(held())) << text_of_offset(held());
    EXPECT_EQ(device.word(17), switch_on ? 1 : 0);
  }

  FakeController device;
  std::unique_ptr<ModbusMachine> machine;
  std::stop_source stop;
  HostCompensatorOptions options;
};

using Kind = ReplyFault::Kind;

/// An exception answered to requests.
ReplyFault refusal(int code, Kind kind = Kind::refused) {
  return {kind, std::chrono::milliseconds(0), static_cast<ModbusException>(code)};
}

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
  compensation::Table table = model();
  table.axes["Z"].max_um_per_s = 2.0;  // the machine takes no more
  ASSERT_TRUE(upload_table(*machine, table, {}, {}).result);
  EXPECT_EQ(run_host_compensator(*machine, model(), {}, {}).error().code, ErrorCode::data_does_not_fit);
}

// Every kind of end: the offset is out of the registers and the switch where it was found.

TEST_F(HostCompensatorTest, TurnsTheSwitchOnAndOffAgain) {
  device.set(17, 0);
  options.switch_on = true;
  const auto summary = run_until([&] {
    EXPECT_EQ(device.word(17), 1);
    stop.request_stop();
  });
  ASSERT_TRUE(summary) << describe(summary.error());
  expect_as_found(false);
}

TEST_F(HostCompensatorTest, EndsAfterItsTimeAtZero) {
  options.duration_s = 1.0;
  bool moved = false;
  const auto summary = run_until([&] { moved = true; });
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_TRUE(moved);
  expect_as_found(true);
}

// A gateway's or the controller's exception, at each request in turn, is no end.
TEST_F(HostCompensatorTest, OneExceptionIsOvercome) {
  for (const int code : {4, 5, 6, 10, 11}) {
    for (const auto kind : {Kind::refused, Kind::refused_after}) {
      stop = std::stop_source();
      device.spoil_where([](int request) { return request % 7 == 3; }, refusal(code, kind));
      int more = 20;
      const auto summary = run([&, turns = 0](const CompensatorTurn&) mutable {
        device.set(9, static_cast<std::uint16_t>(100 * ++turns));
        if (device.float_at(144) < -7.9 && --more == 0) stop.request_stop();
      });
      ASSERT_TRUE(summary) << code << ": " << describe(summary.error());
      EXPECT_EQ(summary->lost_turns, 0);
      expect_as_found(true);
    }
  }
}

// A gateway that answers every other request with an exception loses turns, from the first request to the switch.
TEST_F(HostCompensatorTest, HalfOfAllRequestsMayFail) {
  device.set(17, 0);
  options.switch_on = true;
  for (const int code : {6, 11}) {
    stop = std::stop_source();
    std::minstd_rand draw(7);
    device.spoil_where([&](int) { return draw() % 2 == 0; }, refusal(code));
    int more = 20;
    const auto summary = run([&, turns = 0](const CompensatorTurn&) mutable {
      device.set(9, static_cast<std::uint16_t>(100 * ++turns));
      if (device.float_at(144) < -7.9 && --more == 0) stop.request_stop();
    });
    ASSERT_TRUE(summary) << code << ": " << describe(summary.error());
    expect_as_found(false);
  }
}

// A refusal that is no fault of the link ends the work, not the care for the machine.
TEST_F(HostCompensatorTest, ARefusalOnceEndsAtZeroAndSaysSo) {
  device.set(17, 0);
  options.switch_on = true;
  const auto summary = run_until([&] { device.set_on_write(refusing_once(140)); });
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::compensation_ended) << describe(summary.error());
  EXPECT_NE(summary.error().context.at("reason").find("machine_exception"), std::string::npos);
  EXPECT_EQ(summary.error().context.at("switch"), "off");
  expect_as_found(false);
}

TEST_F(HostCompensatorTest, AnExceptionThatStaysSaysWhatTheMachineHeldLast) {
  options.give_up_s = 0.3;
  for (const int code : {4, 10, 11}) {
    device.spoil(-1, {});
    const auto summary = run_until([&] { device.spoil(0, refusal(code), true); });
    ASSERT_FALSE(summary);
    EXPECT_EQ(summary.error().code, ErrorCode::compensation_left) << describe(summary.error());
    EXPECT_EQ(summary.error().context.at("held"), "unknown, last read X 0.0, Y 0.0, Z -8.0 um");
    EXPECT_EQ(summary.error().context.at("switch"), "unknown");
  }
}

// It answers, but does not take 0: what stands in its registers is read back and said.
TEST_F(HostCompensatorTest, AnOffsetThatCannotBeTakenOutIsToldAsReadBack) {
  options.give_up_s = 0.3;
  for (const auto code : {ModbusException::illegal_value, ModbusException::device_failure}) {
    device.set_on_write({});
    stop = std::stop_source();
    const auto summary = run_until([&] {
      device.set_on_write([code](int address, std::span<const std::uint16_t>) -> std::optional<ModbusException> {
        return address == 140 ? std::optional(code) : std::nullopt;
      });
      stop.request_stop();
    });
    ASSERT_FALSE(summary);
    EXPECT_EQ(summary.error().code, ErrorCode::compensation_left) << describe(summary.error());
    EXPECT_EQ(summary.error().context.at("held"), "X 0.0, Y 0.0, Z -8.0 um");
    EXPECT_EQ(summary.error().context.at("switch"), "on");
  }
}

TEST_F(HostCompensatorTest, ALostLinkIsTriedAgainWhileItEnds) {
  const auto summary = run_until([&] {
    device.spoil_where([](int request) { return request < 12; }, {Kind::drop, {}});
    stop.request_stop();
  });
  ASSERT_TRUE(summary) << describe(summary.error());
  expect_as_found(true);
}

TEST_F(HostCompensatorTest, WhatTheObserverThrowsDoesNotKeepTheOffset) {
  device.set(17, 0);
  options.switch_on = true;
  const auto summary = run_until([] { throw std::runtime_error("the disk is full"); });
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::compensation_ended) << describe(summary.error());
  EXPECT_NE(summary.error().context.at("reason").find("the disk is full"), std::string::npos);
  expect_as_found(false);
}

TEST_F(HostCompensatorTest, AModelThatFailsOrThrowsDoesNotKeepTheOffset) {
  bool throws = false;
  bool fails = false;
  options.predictor = [&](double, const std::map<std::string, double>&) -> Result<std::array<double, 3>> {
    if (throws) throw std::runtime_error("no such state");
    if (fails) return fail(ErrorCode::sensor_dead, {{"sensor", "T1_C"}});
    return std::array<double, 3>{0.0, 0.0, 8.0};
  };
  const auto thrown = run_until([&] { throws = true; });
  ASSERT_FALSE(thrown);
  EXPECT_EQ(thrown.error().code, ErrorCode::compensation_ended) << describe(thrown.error());
  expect_as_found(true);
  throws = false;
  const auto failed = run_until([&] {
    fails = true;
    stop.request_stop();
  });
  ASSERT_TRUE(failed) << describe(failed.error());
  expect_as_found(true);
}

// Somebody turns the switch off: a controller that keeps the register must not apply it with the next switching on.
TEST_F(HostCompensatorTest, WithTheSwitchTurnedOffNothingStaysInTheRegisters) {
  const auto summary = run_until([&] {
    device.set(17, 0);
    stop.request_stop();
  });
  ASSERT_TRUE(summary) << describe(summary.error());
  expect_as_found(false);
}

TEST_F(HostCompensatorTest, WhatAFormerEndLeftIsTakenOutBeforeTheSwitchIsTurnedOn) {
  device.set(17, 0);
  device.set_float(140, 30.0);
  options.switch_on = true;
  std::atomic<double> at_switch_um = std::nan("");
  device.on_write = [&](int address, std::span<const std::uint16_t> values) -> std::optional<ModbusException> {
    if (address == 76 && values[0] == 1) at_switch_um = device.float_unlocked(140);
    return std::nullopt;
  };
  const auto summary = run_until([&] { stop.request_stop(); });
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_DOUBLE_EQ(at_switch_um, 0.0);
  expect_as_found(false);
}

// The way out follows the host's clock: that of the controller may stand.
TEST_F(HostCompensatorTest, RunsToZeroWhileTheControllersClockStands) {
  int turns = 0;
  const auto summary = run([&](const CompensatorTurn& turn) {
    if (turn.output.mode == compensation::FollowerMode::stopping) return;
    device.set(9, static_cast<std::uint16_t>(100 * ++turns));
    if (device.float_at(144) < -7.9) stop.request_stop();
  });
  ASSERT_TRUE(summary) << describe(summary.error());
  expect_as_found(true);
}

TEST_F(HostCompensatorTest, LeavesAtTheMachinesRate) {
  auto slow = model();
  slow.axes["Z"].max_um_per_s = 2.0;  // of the machine's time; 40 um/s of ours
  std::atomic<double> largest_step_um = 0.0;
  double before_um = 0.0;
  std::atomic<bool> stopping = false;
  device.on_write = [&](int address, std::span<const std::uint16_t> values) -> std::optional<ModbusException> {
    if (address != 140) return std::nullopt;
    const double z_um = static_cast<double>(float_at(values, 4));
    if (stopping) largest_step_um = std::max(largest_step_um.load(), std::abs(z_um - before_um));
    before_um = z_um;
    return std::nullopt;
  };
  int turns = 0;
  const auto summary = run_host_compensator(*machine, slow, options, {stop.get_token(), {}}, [&](const auto& turn) {
    device.set(9, static_cast<std::uint16_t>(100 * ++turns));
    if (device.float_at(144) < -7.9 && turn.output.mode != compensation::FollowerMode::stopping) {
      stopping = true;
      stop.request_stop();
    }
  });
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_GT(largest_step_um, 0.0);
  EXPECT_LT(largest_step_um, 7.0) << "not in one leap";
  expect_as_found(true);
}

TEST_F(HostCompensatorTest, WithoutAPermitNothingIsAskedOfTheMachine) {
  auto locked = ModbusMachine::open(device.profile());
  ASSERT_TRUE(locked);
  EXPECT_EQ(run_host_compensator(**locked, model(), {}, {}).error().code, ErrorCode::access_locked);
  EXPECT_EQ(device.requests(), 0);
}

}  // namespace zerodrift::controller
