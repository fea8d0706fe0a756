#include "core/acquisition/recorder.h"

#include "core/acquisition/run.h"
#include "core/base/real_time.h"

namespace zerodrift::acquisition {

std::string_view name_of(RunPhase phase) {
  switch (phase) {
    case RunPhase::starting:
      return "starting";
    case RunPhase::running:
      return "running";
    case RunPhase::measuring:
      return "measuring";
    case RunPhase::paused:
      return "paused";
    case RunPhase::link_lost:
      return "link_lost";
    case RunPhase::ended:
      return "ended";
  }
  return "";
}

Guard compensation_must_be_off(std::string operation) {
  return [operation = std::move(operation)](const MachineSample& sample) -> Status {
    if (!sample.compensation_on) return {};
    return fail(ErrorCode::interlock_compensation_on, {{"operation", operation}});
  };
}

Guard compensation_must_be_on(std::string operation) {
  return [operation = std::move(operation)](const MachineSample& sample) -> Status {
    if (sample.compensation_on) return {};
    return fail(ErrorCode::interlock_compensation_off, {{"operation", operation}});
  };
}

Recorder::Recorder(MachineIo& machine, ErrorSource& errors, Clock& clock, RunSink& sink, RecorderOptions options)
    : m_machine(machine),
      m_errors(errors),
      m_clock(clock),
      m_sink(sink),
      m_options(std::move(options)),
      m_control(std::make_unique<RunControl>()) {}

Recorder::~Recorder() = default;

Result<RunSummary> Recorder::run(const Plan& plan, const TaskContext& context) {
  const std::stop_callback link(context.stop, [this] { m_control->stop().request_stop(); });
  const RealTimeTurns turns(m_options.real_time);
  return Run(m_machine, m_errors, m_clock, m_sink, m_options, *m_control, context).start(plan);
}

Result<RunSummary> Recorder::resume(const InterruptedRun& interrupted, const TaskContext& context) {
  const std::stop_callback link(context.stop, [this] { m_control->stop().request_stop(); });
  const RealTimeTurns turns(m_options.real_time);
  return Run(m_machine, m_errors, m_clock, m_sink, m_options, *m_control, context).go_on(interrupted);
}

}  // namespace zerodrift::acquisition
