#pragma once
// Runs a warm-up plan: commands the machine, samples it at every sample period, at every measure period stops the path
// at the measuring position and measures the errors - where that takes longer than the period, every second or third
// time, which is a problem that is shown - and hands every row to the sink, which is made to keep it at least
// once a second of wall time. time_s is the machine's own clock since the start of the run.
//
// A broken link is waited for and leaves a gap; a sensor or camera that fails is a problem that is shown and recorded.
// However the run ends, the path is stopped, the spindle and the coolant are off.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/acquisition/drift_limit.h"
#include "core/acquisition/error_source.h"
#include "core/acquisition/happening.h"
#include "core/acquisition/machine_io.h"
#include "core/acquisition/run_control.h"
#include "core/acquisition/run_sink.h"
#include "core/acquisition/trend.h"
#include "core/base/clock.h"
#include "core/base/task_context.h"

namespace zerodrift::acquisition {

enum class RunPhase { starting, running, measuring, paused, link_lost, ended };
/// "running" and so on.
std::string_view name_of(RunPhase phase);

/// What the recorder tells while it runs, in its own thread.
struct RunUpdate {
  RunPhase phase = RunPhase::starting;
  double time_s = 0.0;
  std::size_t plan_step = 0;
  double fraction = 0.0;
  double seconds_left = 0.0;  // of machine time
  std::vector<double> row;    // in the order of `channels`; empty when there is no new one
  std::vector<std::string> channels;
  std::vector<Error> problems;      // as of now
  std::vector<Happening> happened;  // since this run began or was taken up again
  TrendNow trend;
  std::int64_t rows = 0;
  std::int64_t committed_rows = 0;  // acknowledged by the sink
  std::int64_t lost_samples = 0;    // sample periods without a row, other than while measuring
  int measurements = 0;
  int refused = 0;                      // measurements with a direction missing
  std::optional<ErrorSample> measured;  // when this update has one
};

/// Checks a reading before the start and at every sample; an error ends the run with it.
using Guard = std::function<Status(const MachineSample&)>;
/// interlock_compensation_on while the switch is on: an uncompensated run must not see a compensated machine.
Guard compensation_must_be_off(std::string operation);
/// interlock_compensation_off while it is off, for the verification run.
Guard compensation_must_be_on(std::string operation);

struct RecorderOptions {
  std::string name = "warm-up";
  double time_factor = 1.0;                      // machine seconds in a host second; the clock given runs at this rate
  double commit_period_s = 1.0;                  // of wall time
  double link_patience_s = 600.0;                // of wall time, then the run is given up (and can be resumed)
  int failed_measurements = 10;                  // in a row, then the run is given up
  bool real_time = false;                        // ask for turns before other threads' (core/base/real_time.h)
  bool with_compensation = false;                // also record the switch and what is applied
  std::optional<std::array<double, 3>> zero_um;  // use this zero instead of taking one at the start
  std::optional<double> zero_age_s;              // machine time since that zero was taken; nothing: not known
  DriftRule drift;                               // what heat can make of an error
  int least_measurements = 30;                   // good ones; or half of what the plan asks for, where that is less
  bool refuse_too_few = false;                   // a run that will not come to them ends in its first tenth
  Clock* host = nullptr;                         // by which the error source stamps its pictures; null: the computer's
  Guard guard = compensation_must_be_off("recording");
  /// Called after each reading in the recorder's thread and may use the machine: the host compensator's place.
  std::function<Status(const MachineSample&)> each_sample;
  std::function<void(const RunUpdate&)> observer;
};

struct RunSummary {
  RunEnd end = RunEnd::finished;
  std::int64_t rows = 0;
  std::int64_t lost_samples = 0;
  int measurements = 0;
  int refused = 0;
  int gaps = 0;
  double duration_s = 0.0;
  TrendNow trend;
  bool machine_stopped = true;  // the machine took the command that ends the run
};

class Recorder {
 public:
  Recorder(MachineIo& machine, ErrorSource& errors, Clock& clock, RunSink& sink, RecorderOptions options);
  ~Recorder();

  /// Works to the end of the plan. no_measuring_position when the plan leaves one of the machine's linear axes open.
  /// Errors leave the series open, so that it can be resumed; so does stopping by the context (cancelled). Aborting by
  /// the control is a regular end.
  Result<RunSummary> run(const Plan& plan, const TaskContext& context);
  /// Goes on with a run that was broken off. Refused when it is another machine or the zero cannot be restored.
  Result<RunSummary> resume(const InterruptedRun& interrupted, const TaskContext& context);

  RunControl& control() { return *m_control; }

 private:
  MachineIo& m_machine;
  ErrorSource& m_errors;
  Clock& m_clock;
  RunSink& m_sink;
  RecorderOptions m_options;
  std::unique_ptr<RunControl> m_control;
};

}  // namespace zerodrift::acquisition
