#include "core/acquisition/recorder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "fake_machine.h"
#include "memory_sink.h"

namespace zerodrift::acquisition {
namespace {

class RecorderTest : public testing::Test {
 protected:
  RecorderTest() {
    plan.name = "test";
    plan.sample_period_s = 10.0;
    plan.measure_period_s = 60.0;
    plan.measure_position_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
    plan.steps = {{1200.0, 3000.0, true, true}, {600.0, 1000.0, false, false}};
  }

  Result<RunSummary> run() {
    Recorder recorder(machine, errors, clock, sink, options);
    control = &recorder.control();
    auto result = recorder.run(plan, {});
    control = nullptr;
    return result;
  }
  /// Calls once when the run has come to this time.
  void at(double time_s, std::function<void()> act) {
    options.observer = [time_s, act, done = false, before = options.observer](const RunUpdate& update) mutable {
      if (before) before(update);
      if (!done && update.time_s >= time_s) {
        done = true;
        act();
      }
    };
  }

  void expect_safe() const {
    ASSERT_FALSE(machine.commands.empty());
    EXPECT_EQ(machine.commands.back().spindle_rpm, 0.0);
    EXPECT_FALSE(machine.commands.back().coolant_on);
    EXPECT_FALSE(machine.commands.back().path_cycle);
  }

  ManualClock clock;
  FakeMachine machine{clock};
  FakeErrors errors{clock};
  MemorySink sink;
  Plan plan;
  RecorderOptions options;
  RunControl* control = nullptr;
};

TEST_F(RecorderTest, WorksThroughThePlan) {
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(summary->end, RunEnd::finished);
  EXPECT_EQ(sink.ended, RunEnd::finished);
  EXPECT_EQ(sink.committed, sink.times.size());
  // Begins at rest, at zero; then the first step; the second; and in the end the machine stands.
  EXPECT_EQ(sink.value(0, "spindle_rpm"), 0.0);
  EXPECT_NEAR(sink.value(0, "dZ_um"), 0.0, 0.1);
  EXPECT_EQ(sink.value(5, "spindle_rpm"), 3000.0);
  EXPECT_EQ(sink.value(5, "coolant_on"), 1.0);
  EXPECT_EQ(sink.value(sink.rows.size() - 2, "spindle_rpm"), 1000.0);
  expect_safe();
  // A row every 10 s, except those that measuring (5 s) has taken along; a measurement every 60 s and one at the end.
  EXPECT_NEAR(double(sink.rows.size()), 181.0, 4.0);
  EXPECT_EQ(summary->measurements, 31);
  EXPECT_EQ(summary->lost_samples, 0);
  EXPECT_NEAR(sink.times.back(), 1800.0, 5.0);
  for (std::size_t i = 1; i < sink.times.size(); ++i) ASSERT_LE(sink.times[i] - sink.times[i - 1], 14.0) << i;
  EXPECT_EQ(sink.count("step"), 2);
  EXPECT_EQ(sink.count("problem"), 0);
  EXPECT_GT(summary->trend.largest_error_um, 10.0);
}

// A measurement takes five of these periods: none of them counts as lost, and one that really is lost does.
TEST_F(RecorderTest, MeasuringLosesNothingAtAShortPeriod) {
  plan.sample_period_s = 1.0;
  const auto summary = run();
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->lost_samples, 0);
  EXPECT_EQ(summary->measurements, 31);
  EXPECT_GE(sink.times.size(), 1800U - 31U * 5U);
}

TEST_F(RecorderTest, CountsWhatASlowReadingLoses) {
  plan.sample_period_s = 1.0;
  machine.change = [&, slow = false](MachineSample&) mutable {
    if (slow || machine.now_s() < 730.5) return;
    slow = true;
    clock.advance(Seconds(4.0));
  };
  const auto summary = run();
  ASSERT_TRUE(summary);
  EXPECT_GE(summary->lost_samples, 3);
  EXPECT_LE(summary->lost_samples, 4);
}

TEST_F(RecorderTest, HasTheContractsChannels) {
  options.with_compensation = true;
  ASSERT_TRUE(run());
  const std::vector<std::string> expected = {
      "spindle_rpm",  "feed_X_mm_min", "feed_Y_mm_min", "feed_Z_mm_min", "coolant_on", "spindle_load_W",
      "ambient_C",    "T1_C",          "T2_C",          "T3_C",          "T4_C",       "dX_um",
      "dY_um",        "dZ_um",         "sigma_X_nm",    "sigma_Y_nm",    "sigma_Z_nm", "compensation_on",
      "applied_X_nm", "applied_Y_nm",  "applied_Z_nm"};
  EXPECT_EQ(sink.start.channels, expected);
  EXPECT_TRUE(std::isnan(sink.value(1, "dZ_um")));
  EXPECT_EQ(sink.value(0, "sigma_Z_nm"), 300.0);
}

TEST_F(RecorderTest, MeasuresAtRestAtItsPositionWithTheSpindleTurning) {
  bool turning_and_still = true;
  errors.failure = [&](double time_s) {
    if (time_s > 30.0 && time_s < 1100.0) turning_and_still &= machine.rpm == 3000.0 && !machine.cycle;
    return false;
  };
  ASSERT_TRUE(run());
  EXPECT_TRUE(turning_and_still);
  EXPECT_GE(machine.moves, 31);
}

TEST_F(RecorderTest, ARowBelongsToTheMiddleOfAMeasurement) {
  plan.steps = {{120.0, 0.0, false, false}};
  errors.measure_s = 5.0;
  ASSERT_TRUE(run());
  EXPECT_NEAR(sink.times.front(), 2.5, 0.1);
}

TEST_F(RecorderTest, ARowBelongsToTheMomentOfItsPicturesWhenTheSourceTellsIt) {
  plan.steps = {{120.0, 0.0, false, false}};
  errors.measure_s = 5.0;
  errors.seen_at_once = true;
  ASSERT_TRUE(run());
  EXPECT_LT(sink.times.front(), 0.5);
}

TEST_F(RecorderTest, DoesNotStartOnACompensatedMachine) {
  machine.change = [](MachineSample& sample) { sample.compensation_on = true; };
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::interlock_compensation_on);
  EXPECT_TRUE(machine.commands.empty()) << "nothing moves";
  EXPECT_TRUE(sink.rows.empty());
}

TEST_F(RecorderTest, StopsWhenCompensationIsSwitchedOn) {
  machine.change = [&](MachineSample& sample) { sample.compensation_on = machine.now_s() > 300.0; };
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::interlock_compensation_on);
  EXPECT_LT(sink.times.back(), 310.0);
  EXPECT_FALSE(sink.ended) << "left open, to be resumed";
  EXPECT_EQ(sink.count("problem", "interlock_compensation_on"), 1);
  EXPECT_EQ(sink.committed, sink.times.size());
  expect_safe();
}

TEST_F(RecorderTest, VerificationNeedsTheSwitchOn) {
  options.guard = compensation_must_be_on("verification");
  EXPECT_EQ(run().error().code, ErrorCode::interlock_compensation_off);
}

TEST_F(RecorderTest, WaitsForAPulledCable) {
  machine.cable_is_out = [](double time_s) { return time_s > 305.0 && time_s < 500.0; };
  std::vector<RunPhase> phases;
  options.observer = [&](const RunUpdate& update) { phases.push_back(update.phase); };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(summary->gaps, 1);
  EXPECT_GE(summary->lost_samples, 17);
  EXPECT_LE(summary->lost_samples, 20);
  EXPECT_EQ(sink.count("problem", "machine_link_lost"), 1);
  EXPECT_EQ(sink.count("cleared", "link"), 1);
  EXPECT_EQ(sink.count("gap", "link"), 1);
  EXPECT_NE(std::find(phases.begin(), phases.end(), RunPhase::link_lost), phases.end());
  EXPECT_NEAR(sink.times.back(), 1800.0, 5.0);
  // The machine was told again what to do.
  EXPECT_EQ(sink.value(80, "spindle_rpm"), 3000.0);
}

// An exception of a gateway, a busy or a failing controller in an unattended run: nothing stops, next to nothing is
// lost.
TEST_F(RecorderTest, WaitsForWhateverMayPass) {
  for (const auto code : {ErrorCode::machine_gateway, ErrorCode::machine_failed, ErrorCode::machine_busy}) {
    SCOPED_TRACE(std::string(name_of(code)));
    const double begin_s = clock.steady().count();
    machine.link_error = code;
    machine.commands.clear();
    machine.cable_is_out = [begin_s](double time_s) { return time_s > begin_s + 305.0 && time_s < begin_s + 306.0; };
    const auto summary = run();
    ASSERT_TRUE(summary) << describe(summary.error());
    EXPECT_EQ(summary->end, RunEnd::finished);
    EXPECT_LE(summary->lost_samples, 1);
    const auto stops = std::count_if(machine.commands.begin(), machine.commands.end() - 1,
                                     [](const auto& command) { return command.spindle_rpm == 0.0; });
    EXPECT_EQ(stops, 1) << "at the start, for the zero";
  }
}

TEST_F(RecorderTest, CountsLostSamplesWhileTheMachineIsAway) {
  machine.cable_is_out = [](double time_s) { return time_s > 305.0 && time_s < 500.0; };
  std::vector<std::int64_t> lost;
  options.observer = [&](const RunUpdate& update) {
    if (update.phase == RunPhase::link_lost) lost.push_back(update.lost_samples);
  };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  ASSERT_FALSE(lost.empty());
  EXPECT_LE(lost.front(), 1);
  EXPECT_TRUE(std::is_sorted(lost.begin(), lost.end()));
  EXPECT_GE(lost.back(), 10);
  EXPECT_LE(lost.back(), summary->lost_samples);
}

// Refusals of all lengths at any moment: lost is each period without a row, and nothing else.
TEST_F(RecorderTest, CountsEachPeriodWithoutARow) {
  plan.sample_period_s = 1.0;
  plan.measure_period_s = 5000.0;
  plan.steps = {{600.0, 3000.0, false, false}};
  machine.link_error = ErrorCode::machine_gateway;
  machine.move_s = 0.0;  // measuring takes the place of no sample here
  errors.measure_s = 0.0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    Noise noise(seed);
    const double begin_s = clock.steady().count();
    std::vector<std::pair<double, double>> outs;
    for (double at_s = begin_s + 20.0; at_s < begin_s + 590.0; at_s += 6.0 + 10.0 * std::abs(noise.normal())) {
      outs.emplace_back(at_s, at_s + 1.5 * std::abs(noise.normal()));
    }
    machine.cable_is_out = [outs](double time_s) {
      return std::any_of(outs.begin(), outs.end(),
                         [&](const auto& o) { return time_s > o.first && time_s < o.second; });
    };
    MemorySink rows;
    Recorder recorder(machine, errors, clock, rows, options);
    const auto summary = recorder.run(plan, {});
    ASSERT_TRUE(summary) << describe(summary.error());
    std::set<long> periods;
    for (const double time_s : rows.times) periods.insert(static_cast<long>(std::floor(time_s + 0.1)));
    const long whole = *periods.rbegin() + 1;
    EXPECT_EQ(summary->rows, std::ssize(rows.times));
    EXPECT_LE(std::abs(whole - std::ssize(periods) - summary->lost_samples), 1)
        << whole << " periods, " << periods.size() << " with a row, " << summary->lost_samples << " lost";
  }
}

TEST_F(RecorderTest, ThePlanStandsWhileTheMachineIsAway) {
  machine.cable_is_out = [](double time_s) { return time_s > 305.0 && time_s < 500.0; };
  std::vector<double> left_s;
  std::vector<double> after_s;
  options.observer = [&](const RunUpdate& update) {
    if (update.phase == RunPhase::link_lost) {
      left_s.push_back(update.seconds_left);
    } else if (!left_s.empty()) {
      after_s.push_back(update.seconds_left);
    }
  };
  ASSERT_TRUE(run());
  ASSERT_GE(left_s.size(), 3u);
  EXPECT_NEAR(left_s.front(), 1500.0, 15.0);
  EXPECT_DOUBLE_EQ(left_s.back(), left_s.front());
  ASSERT_FALSE(after_s.empty());
  EXPECT_NEAR(after_s.front(), 1300.0, 30.0);  // it went on all the same, as the machine's clock says
}

TEST_F(RecorderTest, FinishesWithoutAMachineThatIsAway) {
  machine.cable_is_out = [](double time_s) { return time_s > 305.0; };
  options.observer = [&](const RunUpdate& update) {
    if (update.phase == RunPhase::link_lost) control->finish();
  };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(summary->end, RunEnd::finished);
  EXPECT_FALSE(summary->machine_stopped);
  EXPECT_TRUE(sink.ended);
  EXPECT_GE(sink.times.back(), 290.0);
  EXPECT_LT(clock.steady().count(), 400.0);
  EXPECT_EQ(sink.count("problem", "machine_not_stopped"), 1);
}

TEST_F(RecorderTest, GivesUpACableThatStaysOut) {
  machine.cable_is_out = [](double time_s) { return time_s > 305.0; };
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::machine_link_lost);
  EXPECT_EQ(summary.error().context.at("machine_stopped"), "no");
  EXPECT_FALSE(sink.ended);
  EXPECT_EQ(sink.committed, sink.times.size());
}

TEST_F(RecorderTest, NoticesThatTheMachineWasRestarted) {
  machine.cable_is_out = [&](double time_s) {
    if (time_s > 400.0) machine.clock_zero_s = 350.0;
    return time_s > 305.0 && time_s < 500.0;
  };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(sink.count("clock", "restarted"), 1);
  for (std::size_t i = 1; i < sink.times.size(); ++i) ASSERT_GT(sink.times[i], sink.times[i - 1]);
  // While it was off the plan stood still: 1800 s and the gap.
  EXPECT_NEAR(sink.times.back(), 2000.0, 20.0);
}

// The computer slept for an hour with the lid closed: its steady clock stood, the machine's went on.
TEST_F(RecorderTest, NamesTheHoleOfASleep) {
  plan.steps = {{7200.0, 3000.0, true, true}};
  at(500.0, [&] { machine.clock_zero_s -= 3600.0; });
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(sink.count("gap", "asleep"), 1);
  EXPECT_EQ(summary->gaps, 1);
  EXPECT_NEAR(sink.times.back(), 7200.0, 20.0);  // by the machine's clock, and so by its heat
  int hours = 0;
  for (std::size_t i = 1; i < sink.times.size(); ++i) {
    ASSERT_GT(sink.times[i], sink.times[i - 1]);
    hours += int(sink.times[i] - sink.times[i - 1] > 3500.0);
  }
  EXPECT_EQ(hours, 1);
  EXPECT_LT(sink.times.size(), 500U);  // what was missed is not made up for
}

TEST_F(RecorderTest, PausesAndResumes) {
  at(300.0, [&] { control->pause(); });
  at(700.0, [&] {
    EXPECT_EQ(machine.rpm, 0.0);
    control->resume();
  });
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(sink.count("pause"), 1);
  EXPECT_EQ(sink.count("resume"), 1);
  EXPECT_NEAR(sink.times.back(), 2200.0, 15.0) << "the plan stood still";
  EXPECT_NEAR(double(sink.rows.size()), 220.0, 8.0) << "temperatures were recorded on";
  EXPECT_EQ(summary->measurements, 31);
}

TEST_F(RecorderTest, FinishesEarlyWithALastMeasurement) {
  at(300.0, [&] { control->finish(); });
  const auto summary = run();
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->end, RunEnd::finished);
  EXPECT_NEAR(sink.times.back(), 310.0, 15.0);
  EXPECT_FALSE(std::isnan(sink.value(sink.rows.size() - 1, "dZ_um")));
  expect_safe();
}

TEST_F(RecorderTest, Aborts) {
  at(300.0, [&] { control->abort(); });
  const auto summary = run();
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->end, RunEnd::aborted);
  EXPECT_EQ(sink.ended, RunEnd::aborted);
  expect_safe();
}

TEST_F(RecorderTest, StopsWithTheProgramAndStaysOpen) {
  std::stop_source stop;
  at(300.0, [&] { stop.request_stop(); });
  Recorder recorder(machine, errors, clock, sink, options);
  const auto summary = recorder.run(plan, {stop.get_token(), {}});
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::cancelled);
  EXPECT_FALSE(sink.ended);
  expect_safe();
}

TEST_F(RecorderTest, KeepsNotes) {
  at(300.0, [&] { control->note("door opened"); });
  ASSERT_TRUE(run());
  EXPECT_EQ(sink.count("note", "door opened"), 1);
}

TEST_F(RecorderTest, ShowsACameraThatFailsAndGoesOn) {
  errors.failure = [](double time_s) { return time_s > 300.0 && time_s < 500.0; };
  std::size_t most = 0;
  options.observer = [&](const RunUpdate& update) { most = std::max(most, update.problems.size()); };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(most, 1u);
  EXPECT_EQ(sink.count("problem", "camera_silent"), 1);
  EXPECT_EQ(sink.count("cleared", "errors"), 1);
  EXPECT_LT(summary->measurements, 31);
  EXPECT_EQ(summary->lost_samples, 0);
}

TEST_F(RecorderTest, GivesUpACameraThatStaysDead) {
  errors.failure = [](double time_s) { return time_s > 300.0; };
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::camera_silent);
  EXPECT_FALSE(sink.ended);
}

TEST_F(RecorderTest, DoesNotBeginWithoutAMeasurement) {
  errors.failure = [](double) { return true; };
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::camera_silent);
  EXPECT_LE(sink.rows.size(), 1u);
}

TEST_F(RecorderTest, CountsRefusedFrames) {
  errors.refuse = true;
  const auto summary = run();
  ASSERT_TRUE(summary);
  EXPECT_EQ(summary->refused, summary->measurements);
  EXPECT_EQ(sink.count("problem", "target_refused"), 1);
  EXPECT_TRUE(std::isnan(sink.value(0, "dY_um")));
  EXPECT_FALSE(std::isnan(sink.value(0, "dZ_um")));
}

TEST_F(RecorderTest, NamesDeadAndStuckSensors) {
  machine.change = [&](MachineSample& sample) {
    if (machine.now_s() > 200.0) sample.temperature_C[1] = std::nan("");
    if (machine.now_s() > 300.0) sample.temperature_C[2] = 21.0;
  };
  ASSERT_TRUE(run());
  EXPECT_EQ(sink.count("problem", "sensor_dead"), 1);
  EXPECT_EQ(sink.count("problem", "sensor_stuck"), 1);
  EXPECT_TRUE(std::isnan(sink.value(sink.rows.size() - 1, "T2_C")));
}

// Named once each, in the events and in what happened; the run goes on.
TEST_F(RecorderTest, NamesSpikingJumpedAndSwappedSensors) {
  machine.change = [&](MachineSample& sample) {
    auto& value = sample.temperature_C;
    const double now = machine.now_s();
    if (std::fmod(now, 200.0) < 10.0 && now > 200.0) value[1] += 40.0;
    value[2] += now > 400.0 ? 15.0 : 5.0;
    value[3] -= 10.0;
    if (now > 600.0) std::swap(value[0], value[3]);
  };
  std::vector<Happening> happened;
  options.observer = [&](const RunUpdate& update) { happened = update.happened; };
  ASSERT_TRUE(run());
  EXPECT_EQ(sink.count("problem", "sensor_spiking"), 1);
  EXPECT_EQ(sink.count("problem", "sensor_jumped"), 1);
  EXPECT_EQ(sink.count("problem", "sensor_swapped"), 2);
  const auto told = [&](const std::string& name) {
    for (const auto& one : happened) {
      if (one.name == name) return one.what;
    }
    return std::vector<std::string>();
  };
  EXPECT_EQ(told("sensor_spiking"), std::vector<std::string>{"T2_C"});
  EXPECT_EQ(told("sensor_jumped"), std::vector<std::string>{"T3_C"});
  EXPECT_EQ(told("sensor_swapped"), (std::vector<std::string>{"T1_C", "T4_C"}));
}

TEST_F(RecorderTest, KeepsRowsWhileTheDiskIsFull) {
  at(300.0, [&] { sink.full = true; });
  at(600.0, [&] { sink.full = false; });
  bool shown = false;
  options.observer = [&, before = options.observer](const RunUpdate& update) {
    before(update);
    for (const Error& error : update.problems) shown |= error.code == ErrorCode::disk_full;
  };
  ASSERT_TRUE(run());
  EXPECT_TRUE(shown);
  EXPECT_EQ(sink.committed, sink.times.size());
}

// By the wall: each commit takes longer than two sample periods, and no period passes without its row.
TEST_F(RecorderTest, ASlowDiskTakesNoRowAway) {
  SystemClock wall;
  FakeMachine wall_machine{wall};
  FakeErrors wall_errors{wall};
  wall_machine.move_s = 0.0;
  wall_errors.measure_s = 0.01;
  sink.flush_takes = std::chrono::milliseconds(1200);
  plan.sample_period_s = 0.5;
  plan.measure_period_s = 60.0;
  plan.steps = {{5.0, 3000.0, true, true}};
  options.commit_period_s = 0.2;
  Recorder recorder(wall_machine, wall_errors, wall, sink, options);
  const auto summary = recorder.run(plan, {});
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(summary->lost_samples, 0);
  EXPECT_GE(sink.times.size(), 10U);
  EXPECT_EQ(sink.committed, sink.times.size());
}

TEST_F(RecorderTest, SurvivesAClockThatStandsStill) {
  machine.change = [&](MachineSample& sample) {
    const double now = machine.now_s();
    if (now > 300.0 && now < 500.0) sample.machine_time_s = 1300.0;
  };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(sink.count("problem", "machine_bad_reply"), 1);
  for (std::size_t i = 1; i < sink.times.size(); ++i) ASSERT_GT(sink.times[i], sink.times[i - 1]);
}

TEST_F(RecorderTest, StopsOnAnAlarm) {
  machine.change = [&](MachineSample& sample) { sample.alarm = machine.now_s() > 300.0; };
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::machine_not_ready);
  expect_safe();
}

TEST_F(RecorderTest, GivesEachReadingToTheCompensator) {
  int readings = 0;
  options.each_sample = [&](const MachineSample&) -> Status {
    ++readings;
    return {};
  };
  ASSERT_TRUE(run());
  EXPECT_EQ(readings, machine.reads);
}

TEST_F(RecorderTest, TellsProgress) {
  double fraction = 0.0;
  double left = 1e9;
  options.observer = [&](const RunUpdate& update) {
    if (update.phase == RunPhase::starting) return;
    EXPECT_GE(update.fraction, fraction);
    EXPECT_LE(update.seconds_left, left);
    fraction = update.fraction;
    left = update.seconds_left;
  };
  ASSERT_TRUE(run());
  EXPECT_NEAR(fraction, 1.0, 1e-9);
}

TEST_F(RecorderTest, DoesNotStartWithoutAMeasuringPosition) {
  plan.measure_position_mm.clear();
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::no_measuring_position);
  EXPECT_TRUE(machine.commands.empty()) << "nothing moves";
  EXPECT_TRUE(sink.rows.empty());
}

TEST_F(RecorderTest, DoesNotStartWithoutThePositionOfAnAxisThatTheMachineHas) {
  plan.measure_position_mm.erase("Y");
  machine.change = [](MachineSample& sample) { sample.axes = {{"X", 0.0}, {"Y", 7.0}, {"Z", 0.0}}; };
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::no_measuring_position);
  EXPECT_EQ(summary.error().context.at("axes"), "Y");
}

// The controller's readings during and after the pictures decide: what was measured of a machine elsewhere counts not.
TEST_F(RecorderTest, RefusesWhatWasMeasuredOfAMachineThatMoved) {
  bool jogged = false;
  errors.moves = [&](ErrorSample&) { jogged = machine.now_s() > 300.0 && machine.now_s() < 400.0; };
  machine.change = [&](MachineSample& sample) {
    sample.axes = {{"X", jogged ? 0.5 : 0.0}, {"Y", 0.0}, {"Z", 0.0}};
    jogged = false;  // it is back for the next reading
  };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_GE(sink.count("problem", "target_refused"), 1);
  EXPECT_GE(summary->refused, 1);
  EXPECT_LE(summary->refused, 2);
}

TEST_F(RecorderTest, RefusesALeapThatHeatCannotMakeAndNamesIt) {
  errors.moves = [&, once = false](ErrorSample& sample) mutable {
    if (machine.now_s() < 700.0 || once) return;
    once = true;
    sample.error_um[2] += 400.0;
  };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(sink.count("problem", "error_leapt"), 1);
  EXPECT_EQ(summary->refused, 1);
  for (std::size_t i = 0; i < sink.rows.size(); ++i) {
    EXPECT_FALSE(sink.value(i, "dZ_um") > 100.0) << i;
  }
}

TEST_F(RecorderTest, TakesALeapThatStaysWhenThreeApproachesFoundIt) {
  errors.moves = [&](ErrorSample& sample) {
    if (machine.now_s() > 600.0) sample.error_um[0] += 90.0;
  };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(summary->refused, 2);
  EXPECT_EQ(sink.count("problem", "error_leapt"), 1);
  EXPECT_EQ(sink.count("problem", "leap_confirmed"), 1);
  double last_um = 0.0;
  for (std::size_t i = 0; i < sink.rows.size(); ++i) {
    if (std::isfinite(sink.value(i, "dX_um"))) last_um = sink.value(i, "dX_um");
  }
  EXPECT_GT(last_um, 85.0);
}

// What the table takes out of an error at once is no leap of the heat.
TEST_F(RecorderTest, ALeapOfTheCompensationIsNone) {
  const auto on = [&] { return machine.now_s() > 600.0; };
  errors.moves = [&](ErrorSample& sample) {
    if (on()) sample.error_um[2] -= 70.0;
  };
  machine.change = [&](MachineSample& sample) {
    if (on()) sample.applied_um[2] = -70.0;
  };
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(summary->refused, 0);
}

TEST_F(RecorderTest, SaysWhenMeasuringTakesLongerThanItsPeriod) {
  errors.measure_s = 70.0;
  const auto summary = run();
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(sink.count("problem", "measuring_stretched"), 1);
  EXPECT_LT(summary->measurements, 20);
  EXPECT_GT(summary->measurements, 12);
}

TEST_F(RecorderTest, SaysInItsFirstTenthThatTooFewMeasurementsWillCome) {
  errors.refuse = true;
  double said_at_s = 0.0;
  options.observer = [&](const RunUpdate& update) {
    for (const Error& problem : update.problems) {
      if (problem.code == ErrorCode::too_few_measurements && said_at_s == 0.0) said_at_s = update.time_s;
    }
  };
  ASSERT_TRUE(run()) << "recorded to the end, if that is wanted";
  EXPECT_GT(said_at_s, 0.0);
  EXPECT_LE(said_at_s, 0.1 * 1800.0 + 60.0);
  EXPECT_EQ(sink.count("problem", "too_few_measurements"), 1);
}

TEST_F(RecorderTest, EndsInItsFirstTenthWhenTooFewMeasurementsAreRefused) {
  errors.refuse = true;
  options.refuse_too_few = true;
  const auto summary = run();
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::too_few_measurements);
  EXPECT_LE(machine.now_s(), 0.1 * 1800.0 + 70.0);
  expect_safe();
}

}  // namespace
}  // namespace zerodrift::acquisition
