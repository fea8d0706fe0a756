// A run that was broken off goes on from what is in the job.

#include <gtest/gtest.h>

#include <filesystem>

#include "core/acquisition/job_sink.h"
#include "core/acquisition/recorder.h"
#include "core/recording/recording.h"
#include "fake_machine.h"

namespace zerodrift::acquisition {
namespace {

/// UTC that runs with the manual clock from now on, so that gaps are seen by both.
class TestClock : public ManualClock {
 public:
  UtcTime utc() const override {
    return std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now()) +
           std::chrono::duration_cast<std::chrono::milliseconds>(away);
  }
  Seconds away{0.0};  // how long nobody recorded
};

class Resume : public testing::Test {
 protected:
  Resume() {
    std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-resume-XXXXXX").string();
    folder = mkdtemp(pattern.data());
    plan.measure_position_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
    plan.steps = {{1200.0, 3000.0, true, true}, {600.0, 0.0, false, false}};
  }
  ~Resume() override { std::filesystem::remove_all(folder); }

  /// Records until the time, then the program ends.
  void record_until(double time_s) {
    auto job = commissioning::Job::create(folder / "a.zdj");
    ASSERT_TRUE(job);
    JobSink sink(*job);
    std::stop_source stop;
    RecorderOptions options;
    options.observer = [&](const RunUpdate& update) {
      if (pause_at_s > 0.0 && update.time_s >= pause_at_s) pause();
      if (update.time_s >= time_s) stop.request_stop();
    };
    Recorder recorder(machine, errors, clock, sink, options);
    pause = [&] { recorder.control().pause(); };
    EXPECT_EQ(recorder.run(plan, {stop.get_token(), {}}).error().code, ErrorCode::cancelled);
  }
  void pass(double seconds) {
    clock.advance(Seconds(seconds));
    clock.away += Seconds(seconds);
  }
  Result<RunSummary> go_on(commissioning::Job& job, RecorderOptions options = {}) {
    ZD_TRY(const auto interrupted, interrupted_run(job, "warm-up"));
    if (!interrupted) return fail(ErrorCode::internal);
    JobSink sink(job, interrupted->series);
    Recorder recorder(machine, errors, clock, sink, std::move(options));
    return recorder.resume(interrupted->run, {});
  }
  commissioning::Job open() {
    auto job = commissioning::Job::open(folder / "a.zdj");
    EXPECT_TRUE(job);
    return std::move(*job);
  }

  std::filesystem::path folder;
  TestClock clock;
  FakeMachine machine{clock};
  FakeErrors errors{clock};
  Plan plan;
  double pause_at_s = 0.0;
  std::function<void()> pause;
};

TEST_F(Resume, GoesOnInThePlanWithAGap) {
  record_until(500.0);
  const auto zero = errors.zero;
  pass(300.0);
  errors.zero = {};  // another process knows nothing of it
  auto job = open();
  const auto summary = go_on(job);
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_EQ(summary->gaps, 1);
  EXPECT_EQ(errors.zero, zero);
  EXPECT_EQ(errors.zeros_taken, 1);
  const auto all = job.series();
  ASSERT_EQ(all->size(), 1u);
  EXPECT_EQ(all->front().state, commissioning::SeriesState::finished);
  const auto recording = job.read_series(all->front().id);
  ASSERT_TRUE(recording);
  EXPECT_EQ(summary->rows, std::int64_t(recording->rows()));
  EXPECT_NEAR(recording->time_s.back(), 1800.0, 10.0);
  double longest = 0.0;
  for (std::size_t i = 1; i < recording->rows(); ++i) {
    longest = std::max(longest, recording->time_s[i] - recording->time_s[i - 1]);
  }
  EXPECT_NEAR(longest, 300.0, 20.0);
  // The errors go on from the same zero.
  const auto* dZ = recording->find("dZ_um");
  EXPECT_NEAR(dZ->values.back(), errors.raw()[2] - zero[2], 0.1);
  EXPECT_FALSE(*interrupted_run(job));
}

TEST_F(Resume, AfterTheMachineWasRestarted) {
  record_until(500.0);
  machine.clock_zero_s = clock.steady().count() + 100.0;
  pass(300.0);
  auto job = open();
  const auto summary = go_on(job);
  ASSERT_TRUE(summary) << describe(summary.error());
  const auto events = job.events(1);
  EXPECT_EQ(std::count_if(events->begin(), events->end(), [](const auto& e) { return e.kind == "clock"; }), 1);
  const auto recording = job.read_series(1);
  EXPECT_NEAR(recording->time_s.back(), 2100.0, 20.0) << "while it was off the plan stood still";
}

TEST_F(Resume, AfterThePlansEndTakesALastMeasurement) {
  record_until(500.0);
  pass(20000.0);
  auto job = open();
  ASSERT_TRUE(go_on(job));
  const auto recording = job.read_series(1);
  EXPECT_NEAR(recording->time_s.back(), 20500.0, 20.0);
  EXPECT_FALSE(std::isnan(recording->find("dZ_um")->values.back()));
}

TEST_F(Resume, OfAPausedRun) {
  pause_at_s = 300.0;
  record_until(500.0);
  pass(100.0);
  auto job = open();
  ASSERT_TRUE(go_on(job));
  EXPECT_NEAR(job.read_series(1)->time_s.back(), 1800.0 + 300.0, 30.0);
}

TEST_F(Resume, IsJudgedForTooFewMeasurementsLikeAFreshRun) {
  record_until(500.0);
  pass(100.0);
  errors.refuse = true;
  auto job = open();
  EXPECT_EQ((*interrupted_run(job, "warm-up"))->run.good_measurements, 9) << "one a minute until then";
  RecorderOptions options;
  options.refuse_too_few = true;
  const auto summary = go_on(job, options);
  ASSERT_FALSE(summary);
  EXPECT_EQ(summary.error().code, ErrorCode::too_few_measurements);
  EXPECT_EQ(summary.error().context.at("expected"), "9") << "those that were good before count";
  EXPECT_LE(machine.now_s(), 600.0 + 0.1 * 1200.0 + 70.0) << "within the first tenth of what remained";
  // What was in the way is gone: it goes on to the end.
  errors.refuse = false;
  const auto again = go_on(job, options);
  ASSERT_TRUE(again) << describe(again.error());
}

TEST_F(Resume, CountsTheGoodMeasurementsOfBefore) {
  record_until(1500.0);
  errors.refuse = true;  // from now on none is good; there are enough
  auto job = open();
  RecorderOptions options;
  options.refuse_too_few = true;
  const auto summary = go_on(job, options);
  ASSERT_TRUE(summary) << describe(summary.error());
}

TEST_F(Resume, IsRefusedOnAnotherMachine) {
  record_until(500.0);
  machine.identity.serial = 1;
  auto job = open();
  EXPECT_EQ(go_on(job).error().code, ErrorCode::machine_unsupported);
}

TEST_F(Resume, IsRefusedWithOtherSensors) {
  record_until(500.0);
  machine.identity.sensors.pop_back();
  auto job = open();
  EXPECT_EQ(go_on(job).error().code, ErrorCode::data_does_not_fit);
}

TEST_F(Resume, IsRefusedWithoutTheZero) {
  record_until(500.0);
  errors.keeps_zero = false;
  auto job = open();
  EXPECT_EQ(go_on(job).error().code, ErrorCode::machine_not_ready);
}

TEST_F(Resume, IsRefusedWhileCompensationIsOn) {
  record_until(500.0);
  machine.change = [](MachineSample& sample) { sample.compensation_on = true; };
  auto job = open();
  EXPECT_EQ(go_on(job).error().code, ErrorCode::interlock_compensation_on);
}

TEST_F(Resume, NothingToResumeInANewJob) {
  auto job = commissioning::Job::create(folder / "b.zdj");
  ASSERT_TRUE(job);
  const auto interrupted = interrupted_run(*job);
  ASSERT_TRUE(interrupted);
  EXPECT_FALSE(interrupted->has_value());
}

}  // namespace
}  // namespace zerodrift::acquisition
