#pragma once
// One run of a recorder, from its first command to its end. Inside core/acquisition only.

#include "core/acquisition/problem_list.h"
#include "core/acquisition/recorder.h"
#include "core/acquisition/run_log.h"
#include "core/acquisition/run_row.h"
#include "core/acquisition/sample_grid.h"
#include "core/acquisition/sensor_watch.h"

namespace zerodrift::acquisition {

class Run {
 public:
  Run(MachineIo& machine, ErrorSource& errors, Clock& clock, RunSink& sink, const RecorderOptions& options,
      RunControl& control, const TaskContext& context);

  Result<RunSummary> start(const Plan& plan);
  Result<RunSummary> go_on(const InterruptedRun& interrupted);

 private:
  // starting, in run_start.cpp
  Status connect();
  Status take_zero(const Stand& stand);
  Status rejoin(const InterruptedRun& interrupted, const MachineSample& now);

  // the loop, in run.cpp; measuring, in run_measure.cpp
  /// `at_rest`: where the machine stands before anything turns, for the first row; nothing: the run goes on.
  Result<RunSummary> record(const std::optional<Stand>& at_rest);
  Result<RunEnd> loop(const std::optional<Stand>& at_rest);
  Status obey_controls();
  Status command_step();
  Status take_sample();
  Status measure();
  Status measure_here(Stand stand);
  /// A measurement with the machine's state at its moment.
  struct Taken {
    Result<ErrorSample> measured = fail(ErrorCode::internal);
    MachineSample row;
  };
  Result<Taken> take(const Stand& stand);
  double next_measure_s(const PlanStep& step) const;
  void note_pace(double due_s);
  Status expect_enough();
  void publish(RunPhase phase, const std::vector<double>* row = nullptr, const ErrorSample* measured = nullptr);
  std::int64_t missing_now() const;
  double idle_s() const;
  void wait_for_next();
  Status keep(const MachineSample& sample, const ErrorSample* error, bool expected_late);
  void watch_sensors(const MachineSample& sample);
  std::optional<Error> refusal_of(const MachineSample& row, ErrorSample& measured);
  void add_latency(double time_s, ErrorSample& measured) const;
  void note_measurement(const Result<ErrorSample>& measured, const std::optional<Error>& refused);
  void note_settled(const ErrorSample& measured);
  bool stop_machine();

  // the machine, in run_machine.cpp
  Result<MachineSample> read();
  Status accept(const MachineSample& sample);
  Status command(double spindle_rpm, bool coolant_on, bool path_cycle);
  void watch_speed(const MachineSample& sample);
  void watch_devices(const MachineSample& sample);
  Result<Stand> come_to_measuring_position();
  Status has_measuring_position(const MachineSample& sample) const;
  /// Calls again, with growing pauses, while what fails may pass.
  template <class Call>
  auto patiently(Call call) -> decltype(call());
  Status wait_for_link(const Error& error, double& waited_s, int attempt);
  void note_sleep(double time_s, double host_s);
  void clock_restarted(double machine_time_s, double gap_s);

  void raise(const std::string& key, const Error& error);
  void clear(const std::string& key);
  void event(std::string kind, std::string text, std::string details = "{}");
  double time_now_s() const;  // of the series, estimated from the last reading
  double plan_time_s(double time_s) const;
  bool stopped() const { return m_control.stop().stop_requested(); }
  tl::unexpected<Error> cancelled() const { return fail(ErrorCode::cancelled); }

  MachineIo& m_machine;
  ErrorSource& m_errors;
  Clock& m_clock;
  Clock& m_host;
  const RecorderOptions& m_options;
  RunControl& m_control;
  TaskContext m_context;  // its token also stops on abort
  RunLog m_log;
  RunStart m_start;
  MachineIdentity m_identity;
  std::optional<RowLayout> m_layout;
  std::optional<SensorWatch> m_watch;
  Trend m_trend{60.0};
  ProblemList m_problems;
  Tally m_happened;
  RunSummary m_summary;

  bool m_has_reading = false;
  double m_time_s = 0.0;          // of the last reading
  Seconds m_read_at{0.0};         // when it was taken, by m_clock
  double m_last_row_s = -1.0;     // of the last row
  double m_measured_to_s = -1.0;  // the last sample that was due while measuring
  double m_next_sample_s = 0.0;
  double m_next_measure_s = 0.0;  // of plan time
  double m_paused_s = 0.0;
  std::optional<double> m_paused_since_s;
  std::optional<std::size_t> m_commanded_step;  // nothing: must be commanded (again)
  std::optional<double> m_commanded_rpm;        // as the machine took it last
  std::optional<double> m_other_speed_since_s;  // machine time of the first reading with another speed than that
  std::vector<std::string> m_failing_devices;
  std::optional<std::size_t> m_known_step;  // the conditions the trend counts from
  int m_failed_measurements = 0;
  DriftLimit m_drift;
  struct Good {
    double time_s;
    std::array<double, 3> error_um;
  };
  std::optional<Good> m_good_before;  // the last two good measurements: how fast the errors drift
  std::optional<Good> m_good;
  bool m_enough_expected = false;  // looked at, once
  double m_judged_from_s = 0.0;    // plan time from which measurements are counted for it: the start, or the resumption
  int m_good_stored = 0;           // good measurements from before the resumption
  int m_stale_readings = 0;
  bool m_link_was_lost = false;
};

/// {"code": ..., "context": {...}} for a problem's event.
std::string details_of(const Error& error);

}  // namespace zerodrift::acquisition
