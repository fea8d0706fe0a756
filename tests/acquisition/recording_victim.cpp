// A recording that is made to be killed: records with a machine that is not there into the job given, resumes what it
// finds interrupted, and prints the number of rows after every commit. Its machine's clock is the computer's, so that
// it goes on when this program does not.

#include <cstdio>

#include "core/acquisition/job_sink.h"
#include "core/acquisition/recorder.h"
#include "tests/acquisition/fake_machine.h"

namespace {

using namespace zerodrift;
using namespace zerodrift::acquisition;

class ComputerClock : public SystemClock {
 public:
  Seconds steady() const override { return std::chrono::steady_clock::now().time_since_epoch(); }
  bool wait_until(Seconds deadline, std::stop_token stop) override {
    const Seconds shift = steady() - SystemClock::steady();
    return SystemClock::wait_until(deadline - shift, stop);
  }
};

Result<RunSummary> record(const char* path) {
  ComputerClock clock;
  FakeMachine machine(clock);
  machine.clock_zero_s = 0.0;
  machine.move_s = 0.01;
  FakeErrors errors(clock);
  errors.measure_s = 0.02;
  Plan plan;
  plan.sample_period_s = 0.05;
  plan.measure_period_s = 0.3;
  plan.measure_position_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
  plan.steps.push_back({3600.0, 3000.0, true, true});

  ZD_TRY(auto job, commissioning::Job::open_or_create(path));
  ZD_TRY(const auto interrupted, interrupted_run(job));
  RecorderOptions options;
  options.commit_period_s = 0.1;
  options.observer = [](const RunUpdate& update) {
    std::printf("%lld\n", static_cast<long long>(update.committed_rows));
    std::fflush(stdout);
  };
  JobSink sink = interrupted ? JobSink(job, interrupted->series) : JobSink(job);
  Recorder recorder(machine, errors, clock, sink, options);
  return interrupted ? recorder.resume(interrupted->run, {}) : recorder.run(plan, {});
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const auto summary = record(argv[1]);
  if (summary) return 0;
  std::fprintf(stderr, "%s\n", describe(summary.error()).c_str());
  return 1;
}
