#include "core/acquisition/run.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/acquisition/machine_fault.h"
#include "core/base/json.h"

namespace zerodrift::acquisition {
namespace {

constexpr double shortest_wait_s = 1e-6;
constexpr double slice_s = 0.1;  // wall; how soon a request is seen
constexpr double longest_sink_failure_s = 600.0;

}  // namespace

Run::Run(MachineIo& machine, ErrorSource& errors, Clock& clock, RunSink& sink, const RecorderOptions& options,
         RunControl& control, const TaskContext& context)
    : m_machine(machine),
      m_errors(errors),
      m_clock(clock),
      m_host(options.host == nullptr ? host_clock() : *options.host),
      m_options(options),
      m_control(control),
      m_context{control.stop().get_token(), context.report},
      m_log(sink, options.commit_period_s),
      m_drift(options.drift) {}

Result<RunSummary> Run::record(const std::optional<Stand>& at_rest) {
  Result<RunEnd> end = loop(at_rest);
  if (!end && m_control.abort_requested()) end = RunEnd::aborted;
  // Asked to finish while the machine is away: what was recorded until then is the run.
  const bool away = !end && may_pass(end.error());
  if (away && m_control.finish_requested() && m_log.rows() > 0) end = RunEnd::finished;
  m_summary.machine_stopped = stop_machine();
  if (!m_summary.machine_stopped) event("problem", "machine_not_stopped");
  m_summary.rows = m_log.rows();
  m_summary.duration_s = m_time_s;
  m_summary.trend = m_trend.now();
  if (!end) {
    event("problem", std::string(name_of(end.error().code)), details_of(end.error()));
    m_log.commit();
    publish(RunPhase::ended);
    return fail(std::move(end).error().with("machine_stopped", m_summary.machine_stopped ? "yes" : "no"));
  }
  m_summary.end = *end;
  event("end", *end == RunEnd::finished ? "finished" : "aborted");
  ZD_CHECK(m_log.end(*end));
  publish(RunPhase::ended);
  return m_summary;
}

Result<RunEnd> Run::loop(const std::optional<Stand>& at_rest) {
  if (at_rest) {
    ZD_CHECK(measure_here(*at_rest));
    m_next_measure_s = m_start.plan.measure_period_s;
  }
  for (;;) {
    if (stopped()) return cancelled();
    ZD_CHECK(obey_controls());
    const double plan_s = plan_time_s(time_now_s());
    const bool over = plan_s >= m_start.plan.duration_s() || m_control.finish_requested();
    if (over || (!m_paused_since_s && plan_s >= m_next_measure_s)) {
      if (!over) ZD_CHECK(command_step());
      ZD_CHECK(measure());
      if (over) return RunEnd::finished;
      ZD_CHECK(expect_enough());
    } else {
      if (!m_paused_since_s) ZD_CHECK(command_step());
      if (time_now_s() >= m_next_sample_s) ZD_CHECK(take_sample());
    }
    const auto failure = m_log.failure();
    if (failure && m_log.failing_s() > longest_sink_failure_s) return fail(*failure);
    wait_for_next();
  }
}

double Run::time_now_s() const {
  return m_time_s + (m_clock.steady() - m_read_at).count();
}

double Run::plan_time_s(double time_s) const {
  return (m_paused_since_s ? std::min(time_s, *m_paused_since_s) : time_s) - m_paused_s;
}

Status Run::obey_controls() {
  for (const auto& note : m_control.take_notes()) {
    m_log.event({std::max(0.0, note.time_s.value_or(m_time_s)), "note", note.text, "{}"});
  }
  if (m_control.paused() && !m_paused_since_s) {
    m_paused_since_s = time_now_s();
    m_commanded_step.reset();
    event("pause", "");
    return command(0.0, false, false);
  }
  if (!m_control.paused() && m_paused_since_s) {
    m_paused_s += time_now_s() - *m_paused_since_s;
    m_paused_since_s.reset();
    m_trend.conditions_changed(time_now_s());  // it has cooled meanwhile
    event("resume", "", json_text(nlohmann::json{{"paused_s", m_paused_s}}));
  }
  return {};
}

Status Run::command_step() {
  const std::size_t index = m_start.plan.index_at(plan_time_s(time_now_s()));
  if (m_commanded_step == index) return {};
  const PlanStep& step = m_start.plan.steps[index];
  ZD_CHECK(command(step.spindle_rpm, step.coolant_on, step.path_cycle));
  m_commanded_step = index;
  if (m_known_step == index) return {};
  m_known_step = index;
  m_trend.conditions_changed(time_now_s());
  event("step", std::to_string(index + 1));
  return {};
}

/// Machine time until something is due; in the very terms in which it will be found due.
double Run::idle_s() const {
  const double now_s = time_now_s();
  double idle = m_next_sample_s - now_s;
  if (m_paused_since_s) return idle;
  const double plan_s = plan_time_s(now_s);
  double change_s = 0.0;  // the next step, or the end of the plan: neither waits for a sample
  for (const PlanStep& step : m_start.plan.steps) {
    change_s += step.duration_s;
    if (change_s > plan_s) break;
  }
  return std::min({idle, m_next_measure_s - plan_s, change_s - plan_s});
}

void Run::wait_for_next() {
  const bool paused = m_control.paused();
  for (;;) {
    const double wait_s = idle_s();
    const bool asked = m_control.paused() != paused || m_control.finish_requested();
    if (wait_s <= 0.0 || stopped() || asked) return;
    m_log.commit_before_waiting(wait_s / m_options.time_factor);
    const double left_s = idle_s();
    if (left_s <= 0.0) return;
    // Never so short that rounding makes it nothing.
    const double slice = std::max(shortest_wait_s, std::min(left_s, slice_s * m_options.time_factor));
    m_clock.wait_for(Seconds(slice), m_context.stop);
  }
}

Status Run::take_sample() {
  ZD_TRY(const MachineSample sample, read());
  return keep(sample, nullptr, false);
}

Status Run::keep(const MachineSample& sample, const ErrorSample* error, bool expected_late) {
  const double time_s = sample.machine_time_s - m_start.origin_s;
  m_next_sample_s = next_multiple(time_now_s(), m_start.plan.sample_period_s);
  if (time_s <= m_last_row_s) return {};
  // The row of a measurement lies in its middle; the periods up to its end have passed with it and are not lost.
  const double since_s = std::max(m_last_row_s, m_measured_to_s);
  const auto periods = samples_between(since_s, time_s, m_start.plan.sample_period_s);
  if (expected_late && !m_link_was_lost) m_measured_to_s = m_next_sample_s - m_start.plan.sample_period_s;
  if (m_link_was_lost) {
    ++m_summary.gaps;
    m_happened.add("gap", {});
    event("gap", "link", json_text(nlohmann::json{{"from_s", m_last_row_s}, {"to_s", time_s}}));
  }
  if (m_last_row_s >= 0.0 && periods > 0 && (m_link_was_lost || !expected_late)) m_summary.lost_samples += periods;
  m_link_was_lost = false;
  watch_sensors(sample);
  m_trend.add_temperatures(time_s, sample.temperature_C);
  if (error != nullptr) m_trend.add_error(time_s, error->error_um);
  const std::vector<double> row = m_layout->row(sample, error);
  ZD_CHECK(m_log.append(time_s, row));
  m_last_row_s = time_s;
  publish(m_paused_since_s ? RunPhase::paused : RunPhase::running, &row, error);
  return {};
}

void Run::watch_sensors(const MachineSample& sample) {
  for (const auto& change : m_watch->add(m_time_s, sample.temperature_C)) {
    const std::string key = "sensor " + change.channel;
    if (change.failed) {
      raise(key, change.error);
    } else {
      clear(key);
    }
  }
}

bool Run::stop_machine() {
  // Not patiently: the run may end because the link is gone. A busy device gets a second and a third chance.
  for (int attempt = 0; attempt < 3; ++attempt) {
    if (m_machine.command(0.0, false, false)) return true;
  }
  return false;
}

void Run::raise(const std::string& key, const Error& error) {
  if (!m_problems.raise(key, error)) return;
  m_happened.add(std::string(name_of(error.code)), Tally::particulars_of(error.context));
  event("problem", std::string(name_of(error.code)), details_of(error));
}

void Run::clear(const std::string& key) {
  if (m_problems.clear(key)) event("cleared", key);
}

void Run::event(std::string kind, std::string text, std::string details) {
  m_log.event({std::max(0.0, m_time_s), std::move(kind), std::move(text), std::move(details)});
}

/// Periods that have passed without a row since the link was lost; keep() counts them for good when it is back.
std::int64_t Run::missing_now() const {
  if (!m_link_was_lost || m_last_row_s < 0.0) return 0;
  const double since_s = std::max(m_last_row_s, m_measured_to_s);
  return samples_between(since_s, time_now_s(), m_start.plan.sample_period_s);
}

void Run::publish(RunPhase phase, const std::vector<double>* row, const ErrorSample* measured) {
  RunUpdate update;
  update.phase = phase;
  update.time_s = m_time_s;
  if (!m_start.plan.steps.empty() && m_has_reading) {
    // Without the controller nobody knows whether the plan goes on: its clock stands where it was last seen.
    const double plan_s = plan_time_s(phase == RunPhase::link_lost ? m_time_s : time_now_s());
    const double total_s = m_start.plan.duration_s();
    update.plan_step = m_start.plan.index_at(plan_s);
    update.fraction = std::clamp(plan_s / total_s, 0.0, 1.0);
    update.seconds_left = std::max(0.0, total_s - plan_s);
  }
  m_context.progress(update.fraction, std::string(name_of(phase)), update.seconds_left / m_options.time_factor);
  if (!m_options.observer) return;
  if (row != nullptr) update.row = *row;
  if (measured != nullptr) update.measured = *measured;
  if (m_layout) update.channels = m_layout->channels();
  update.problems = m_problems.now();
  update.happened = m_happened.all();
  if (const auto failure = m_log.failure()) update.problems.push_back(*failure);
  update.trend = m_trend.now();
  update.rows = m_log.rows();
  update.committed_rows = m_log.committed_rows();
  update.lost_samples = m_summary.lost_samples + missing_now();
  update.measurements = m_summary.measurements;
  update.refused = m_summary.refused;
  m_options.observer(update);
}

}  // namespace zerodrift::acquisition
