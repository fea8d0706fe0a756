#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/acquisition/run.h"
#include "core/base/json.h"

namespace zerodrift::acquisition {
namespace {

// Shorter than the host says by more than this share and time: the machine's clock did not run all the while.
constexpr double clock_share = 0.05;
constexpr double least_clock_slack_s = 120.0;
constexpr double host_slack_s = 2.0;  // wall

}  // namespace

Status Run::connect() {
  ZD_TRY(m_identity, m_machine.identify());
  ZD_TRY(const MachineSample first, m_machine.read());
  ZD_CHECK(accept(first));
  ZD_CHECK(has_measuring_position(first));
  m_layout.emplace(m_identity, first, m_options.with_compensation);
  std::vector<std::string> sensors;
  for (const SensorInfo& sensor : m_identity.sensors) sensors.push_back(sensor.channel);
  m_watch.emplace(std::move(sensors));
  return {};
}

Status Run::take_zero(const Stand& stand) {
  constexpr std::array<double, 3> nothing{};
  if (!m_options.zero_um) m_drift.know(0.0, nothing, nothing);
  if (m_options.zero_um && m_options.zero_age_s) m_drift.know(-*m_options.zero_age_s, nothing, nothing);
  if (m_options.zero_um) {
    if (m_errors.restore_zero_um(*m_options.zero_um)) return {};
    return fail(ErrorCode::machine_not_ready, {{"what", m_errors.name()}, {"reason", "its zero cannot be restored"}});
  }
  return m_errors.take_zero(stand, m_context);
}

Result<RunSummary> Run::start(const Plan& plan) {
  m_start.plan = plan;
  m_start.name = m_options.name;
  m_trend = Trend(plan.measure_period_s);
  publish(RunPhase::starting);
  ZD_CHECK(connect());
  // The zero is taken with the spindle at rest: what comes after is the drift of the whole run.
  ZD_CHECK(m_machine.command(0.0, false, false));
  Stand stand;
  const auto zeroed = [&]() -> Status {
    ZD_TRY(stand, come_to_measuring_position());
    return take_zero(stand);
  };
  Status ready = zeroed();
  // Once more where somebody moved it, or something passed before the camera.
  const bool passing =
      !ready && (ready.error().code == ErrorCode::machine_not_ready || ready.error().code == ErrorCode::target_refused);
  if (passing && !stopped()) ready = zeroed();
  if (!ready) {
    if (m_control.abort_requested()) return fail(ErrorCode::cancelled);
    return fail(ready.error());
  }
  ZD_TRY(const MachineSample first, m_machine.read());
  ZD_CHECK(accept(first));
  m_start.channels = m_layout->channels();
  m_start.machine_serial = m_identity.serial;
  m_start.origin_s = first.machine_time_s;
  m_start.zero_um = m_errors.zero_um();
  m_has_reading = true;
  m_time_s = 0.0;
  ZD_CHECK(m_log.begin(m_start));
  event("start", m_errors.name());
  return record(stand);
}

Status Run::rejoin(const InterruptedRun& interrupted, const MachineSample& now) {
  const double last_s = interrupted.last_time_s;
  const double machine_gap_s = now.machine_time_s - m_start.origin_s - last_s;
  const double host_gap_s = std::chrono::duration<double>(m_clock.utc() - interrupted.last_utc).count();
  const double expected_s = host_gap_s * m_options.time_factor;
  const double slack_s =
      std::max({least_clock_slack_s, clock_share * expected_s, host_slack_s * m_options.time_factor});
  m_has_reading = true;
  m_time_s = last_s;
  m_last_row_s = last_s;
  // A machine that was off has a clock that began again: behind the last row, or far behind the host's.
  if (machine_gap_s <= 0.0 || machine_gap_s < expected_s - slack_s) {
    clock_restarted(now.machine_time_s, std::max(expected_s, m_start.plan.sample_period_s));
  }
  m_time_s = now.machine_time_s - m_start.origin_s;
  m_read_at = m_clock.steady();
  if (interrupted.paused_since_s) {
    m_paused_s += std::max(0.0, m_time_s - *interrupted.paused_since_s);
    event("resume", "", json_text(nlohmann::json{{"paused_s", m_paused_s}}));
  }
  ++m_summary.gaps;
  event("gap", "interrupted", json_text(nlohmann::json{{"from_s", last_s}, {"to_s", m_time_s}}));
  return {};
}

Result<RunSummary> Run::go_on(const InterruptedRun& interrupted) {
  m_start = interrupted.start;
  m_trend = Trend(m_start.plan.measure_period_s);
  m_paused_s = interrupted.paused_s;
  m_log.go_on_from(interrupted.rows);
  publish(RunPhase::starting);
  ZD_CHECK(connect());
  if (m_identity.serial != m_start.machine_serial) {
    return fail(ErrorCode::machine_unsupported, {{"what", "serial number"},
                                                 {"found", std::to_string(m_identity.serial)},
                                                 {"expected", std::to_string(m_start.machine_serial)}});
  }
  if (m_layout->channels() != m_start.channels) {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "channels of the machine"},
                 {"found", fmt::format("{}", m_layout->channels().size())},
                 {"expected", fmt::format("the {} of the run", m_start.channels.size())}});
  }
  // Without the zero of the run the errors would go on from another point.
  if (!m_start.zero_um || !m_errors.restore_zero_um(*m_start.zero_um)) {
    return fail(ErrorCode::machine_not_ready, {{"what", m_errors.name()}, {"reason", "its zero cannot be restored"}});
  }
  ZD_TRY(const MachineSample now, m_machine.read());
  ZD_CHECK(m_options.guard(now));
  ZD_CHECK(rejoin(interrupted, now));
  constexpr std::array<double, 3> nothing{};
  m_drift.know(0.0, nothing, nothing);
  m_next_sample_s = m_time_s;
  m_next_measure_s = plan_time_s(m_time_s);
  m_judged_from_s = m_next_measure_s;
  m_good_stored = interrupted.good_measurements;
  return record(std::nullopt);
}

}  // namespace zerodrift::acquisition
