// Days of running change nothing: memory, periods and the size of the job over three days of machine time with 32
// channels; and the rate of many channels. Time is given by hand, so that days pass in seconds.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "core/acquisition/job_sink.h"
#include "core/acquisition/recorder.h"
#include "fake_machine.h"
#include "tests/support/amount.h"

namespace zerodrift::acquisition {
namespace {

double resident_MB() {
  std::ifstream stream("/proc/self/statm");
  long total = 0;
  long resident = 0;
  stream >> total >> resident;
  return 1e-6 * double(resident) * double(::sysconf(_SC_PAGESIZE));
}

/// The wall clock is set a day back, then two days ahead, while the run goes on.
class ResetClock : public ManualClock {
 public:
  UtcTime utc() const override {
    const double now = steady().count();
    const auto day = std::chrono::hours(24);
    return ManualClock::utc() + (now > 100000.0  ? std::chrono::milliseconds(day)
                                 : now > 40000.0 ? -std::chrono::milliseconds(day)
                                                 : std::chrono::milliseconds(0));
  }
};

std::filesystem::path fresh_folder() {
  std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-days-XXXXXX").string();
  return ::mkdtemp(pattern.data());
}

}  // namespace

TEST(Endurance, ThreeDaysOfThirtyTwoChannels) {
  const auto folder = fresh_folder();
  ResetClock clock;
  FakeMachine machine(clock, 24);  // with speed, feeds, coolant, load, ambient and the errors some 32 channels
  FakeErrors errors(clock);
  Plan plan;
  plan.sample_period_s = amount(10, 1);
  plan.measure_period_s = 600.0;
  plan.measure_position_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
  plan.steps = {{72.0 * 3600.0, 3000.0, true, true}};
  RecorderOptions options;
  options.commit_period_s = 120.0;
  double after_an_hour_MB = 0.0;
  double largest_MB = 0.0;
  options.observer = [&](const RunUpdate& update) {
    if (update.time_s < 3600.0) return;
    if (after_an_hour_MB == 0.0) after_an_hour_MB = resident_MB();
    largest_MB = std::max(largest_MB, resident_MB());
  };
  RunSummary summary;
  std::size_t channels = 0;
  {
    auto job = commissioning::Job::create(folder / "days.zdj");
    ASSERT_TRUE(job) << describe(job.error());
    JobSink sink(*job);
    Recorder recorder(machine, errors, clock, sink, options);
    auto done = recorder.run(plan, {});
    ASSERT_TRUE(done) << describe(done.error());
    summary = *done;
    channels = job->series()->front().channels.size();
    EXPECT_TRUE(job->check()->ok());
  }
  const double size_MB = 1e-6 * double(std::filesystem::file_size(folder / "days.zdj"));
  const double raw_MB = 8e-6 * double(summary.rows) * double(channels + 1);
  std::filesystem::remove_all(folder);
  std::printf(
      "72 h of machine time: %lld rows of %zu channels, memory grew %.1f MB, job %.1f MB (raw %.1f MB), %lld lost\n",
      static_cast<long long>(summary.rows), channels, largest_MB - after_an_hour_MB, size_MB, raw_MB,
      static_cast<long long>(summary.lost_samples));
  EXPECT_GE(channels, 32U);
  EXPECT_GE(double(summary.rows), 0.98 * 72.0 * 3600.0 / plan.sample_period_s);
  EXPECT_EQ(summary.lost_samples, 0);
  if (!instrumented) {
    EXPECT_LT(largest_MB - after_an_hour_MB, 20.0);
  }
  EXPECT_LT(size_MB, raw_MB + 1.0);  // chunks are compressed; events and pages come on top
}

// 200 channels ten times a second, committed every second as a recorder does.
TEST(Endurance, TwoHundredChannelsAtTenHertz) {
  const int seconds = amount(180, 3600);
  const auto folder = fresh_folder();
  double slowest_ms = 0.0;
  double growth_MB = 0.0;
  double first_MB = 0.0;
  double took_s = 0.0;
  {
    auto job = commissioning::Job::create(folder / "many.zdj");
    ASSERT_TRUE(job);
    std::vector<std::string> channels;
    for (int i = 0; i < 200; ++i) channels.push_back("T" + std::to_string(i + 1) + "_C");
    const auto series = job->start_series("run", channels);
    ASSERT_TRUE(series);
    Noise noise(5);
    std::vector<double> row(channels.size());
    const auto started = std::chrono::steady_clock::now();
    for (int second = 0; second < seconds; ++second) {
      const auto before = std::chrono::steady_clock::now();
      for (int tenth = 0; tenth < 10; ++tenth) {
        for (auto& value : row) value = std::round(160.0 * (20.0 + 0.1 * noise.normal())) / 160.0;
        ASSERT_TRUE(job->append(*series, second + 0.1 * tenth, row));
      }
      ASSERT_TRUE(job->flush());
      const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - before;
      slowest_ms = std::max(slowest_ms, took.count());
      if (second == seconds / 4) first_MB = resident_MB();
    }
    took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    growth_MB = resident_MB() - first_MB;
    ASSERT_TRUE(job->finish_series(*series));
    EXPECT_EQ(job->series_info(*series)->rows, 10 * seconds);
  }
  std::filesystem::remove_all(folder);
  std::printf(
      "200 channels, %d s of data in %.1f s; the slowest second took %.0f ms; memory grew %.1f MB in the last 3/4\n",
      seconds, took_s, slowest_ms, growth_MB);
  EXPECT_LT(took_s, seconds);  // it keeps up
  if (!instrumented) {
    EXPECT_LT(growth_MB, 20.0);
  }
}

// The same rate by the wall: the recorder itself, a row of 200 channels each tenth of a second, for an hour. Only in
// the long check; what the shorter ones can tell is told by the test above.
TEST(Endurance, AnHourByTheWall) {
  if (amount(0, 1) == 0) GTEST_SKIP() << "an hour long: done by ./check --long";
  const auto folder = fresh_folder();
  SystemClock clock;
  FakeMachine machine(clock, 187);  // with speed, feeds, coolant, load, ambient and the errors 200 channels
  FakeErrors errors(clock);
  machine.move_s = 0.2;
  errors.measure_s = 0.3;
  Plan plan;
  plan.sample_period_s = 0.1;
  plan.measure_period_s = 600.0;
  plan.measure_position_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
  plan.steps = {{3600.0, 3000.0, true, true}};
  RecorderOptions options;
  options.real_time = true;  // as with a machine of iron
  double first_MB = 0.0;
  double largest_MB = 0.0;
  double last_s = 0.0;
  double widest_s = 0.0;
  bool measured = true;
  options.observer = [&](const RunUpdate& update) {
    if (update.phase == RunPhase::measuring) measured = true;
    if (update.row.empty()) return;
    if (!measured) widest_s = std::max(widest_s, update.time_s - last_s);
    measured = update.measured.has_value();
    last_s = update.time_s;
    if (update.time_s < 600.0) return;
    if (first_MB == 0.0) first_MB = resident_MB();
    largest_MB = std::max(largest_MB, resident_MB());
  };
  RunSummary summary;
  std::size_t channels = 0;
  {
    auto job = commissioning::Job::create(folder / "hour.zdj");
    ASSERT_TRUE(job) << describe(job.error());
    JobSink sink(*job);
    Recorder recorder(machine, errors, clock, sink, options);
    const auto done = recorder.run(plan, {});
    ASSERT_TRUE(done) << describe(done.error());
    summary = *done;
    channels = job->series()->front().channels.size();
    EXPECT_EQ(job->series()->front().rows, summary.rows);
    EXPECT_TRUE(job->check()->ok());
  }
  std::filesystem::remove_all(folder);
  std::printf(
      "an hour by the wall: %lld rows of %zu channels, %lld lost, widest step %.0f ms, memory grew %.1f MB after the "
      "first ten minutes\n",
      static_cast<long long>(summary.rows), channels, static_cast<long long>(summary.lost_samples), 1e3 * widest_s,
      largest_MB - first_MB);
  EXPECT_EQ(channels, 200U);
  EXPECT_GE(summary.rows, 35900);  // less what each of the seven measurements takes
  EXPECT_EQ(summary.lost_samples, 0);
  if (!instrumented) {
    EXPECT_LT(largest_MB - first_MB, 20.0);
  }
}

}  // namespace zerodrift::acquisition
