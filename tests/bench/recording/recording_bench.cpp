// What recording costs: share of a core for 32 channels at 10 Hz with a commit a second, and for as many as asked; then
// a job of 72 h at 1 Hz: its size, and the time to open, read and check it. Figures, no assertions.

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <filesystem>

#include "core/acquisition/job_sink.h"
#include "core/acquisition/recorder.h"
#include "core/recording/recording.h"
#include "tests/acquisition/fake_machine.h"

namespace {

using namespace zerodrift;
using namespace zerodrift::acquisition;
using commissioning::Job;

constexpr std::size_t channels_beside_sensors = 13;

double cpu_s() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) { return double(t.tv_sec) + 1e-6 * double(t.tv_usec); };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

template <class Work>
double wall_s(Work work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

Status record_live(const std::filesystem::path& file, std::size_t channels, double rate_hz, double duration_s) {
  SystemClock clock;
  FakeMachine machine(clock, channels - channels_beside_sensors);
  machine.move_s = 0.05;
  FakeErrors errors(clock);
  errors.measure_s = 0.2;
  ZD_TRY(auto job, Job::create(file));
  JobSink sink(job);
  Plan plan;
  plan.sample_period_s = 1.0 / rate_hz;
  plan.measure_period_s = 10.0;
  plan.steps.push_back({duration_s, 3000.0, true, true});
  RecorderOptions options;
  std::size_t seen = 0;
  options.observer = [&](const RunUpdate& update) { seen += update.row.size(); };
  Recorder recorder(machine, errors, clock, sink, options);
  const double before = cpu_s();
  Result<RunSummary> summary = fail(ErrorCode::internal);
  const double wall = wall_s([&] { summary = recorder.run(plan, {}); });
  if (!summary) return fail(summary.error());
  fmt::print("record {} channels at {} Hz: {:.2f} % of a core, {} rows in {:.0f} s, {} lost\n", channels, rate_hz,
             100.0 * (cpu_s() - before) / wall, summary->rows, wall, summary->lost_samples);
  return {};
}

Status make_long_job(const std::filesystem::path& file, std::size_t channels, int hours) {
  ZD_TRY(auto job, Job::create(file));
  std::vector<std::string> names;
  for (std::size_t i = 0; i < channels; ++i) names.push_back(fmt::format("T{}_C", i + 1));
  ZD_TRY(const auto series, job.start_series("long", names));
  Noise noise(1);
  std::vector<double> row(channels);
  for (int i = 0; i < hours * 3600; ++i) {
    for (double& value : row) value = std::round(16.0 * (20.0 + 1e-4 * i + 0.1 * noise.normal())) / 16.0;
    ZD_CHECK(job.append(series, i, row));
    if (i % 60 == 59) ZD_CHECK(job.flush());
  }
  return job.flush();
}

Status open_long_job(const std::filesystem::path& file) {
  Result<Job> job = fail(ErrorCode::internal);
  const double opened = wall_s([&] { job = Job::open(file); });
  if (!job) return fail(job.error());
  Result<recording::Recording> recording = fail(ErrorCode::internal);
  const double read = wall_s([&] { recording = job->read_series(1); });
  if (!recording) return fail(recording.error());
  Result<commissioning::CheckReport> report = fail(ErrorCode::internal);
  const double checked = wall_s([&] { report = job->check(); });
  if (!report) return fail(report.error());
  fmt::print("job of {} rows x {} channels, {:.1f} MB: open {:.3f} s, read all {:.3f} s, check {:.3f} s, {} problems\n",
             recording->rows(), recording->channels.size(), double(std::filesystem::file_size(file)) / 1e6, opened,
             read, checked, report->problems.size());
  return {};
}

Status run(const std::filesystem::path& folder, double seconds, int hours) {
  ZD_CHECK(record_live(folder / "live.zdj", 32, 10.0, seconds));
  ZD_CHECK(record_live(folder / "wide.zdj", 200, 10.0, seconds));
  ZD_CHECK(make_long_job(folder / "long.zdj", 32, hours));
  return open_long_job(folder / "long.zdj");
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Cost of recording and of long jobs");
  double seconds = 20.0;
  int hours = 72;
  app.add_option("--seconds", seconds, "Length of the live recordings")->capture_default_str();
  app.add_option("--hours", hours, "Length of the long job")->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::string pattern = (std::filesystem::temp_directory_path() / "zerodrift-bench-XXXXXX").string();
  const std::filesystem::path folder = mkdtemp(pattern.data());
  const Status status = run(folder, seconds, hours);
  std::filesystem::remove_all(folder);
  if (status) return 0;
  fmt::print(stderr, "{}\n", describe(status.error()));
  return 1;
}
