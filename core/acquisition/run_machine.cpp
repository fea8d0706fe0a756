#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/acquisition/machine_fault.h"
#include "core/acquisition/run.h"
#include "core/base/json.h"

namespace zerodrift::acquisition {
namespace {

constexpr double first_pause_s = 0.2;  // wall
constexpr double longest_pause_s = 5.0;
constexpr double budget_share = 0.5;  // of the measuring period, for trying a measurement again
constexpr int attempts_to_finish = 3;
constexpr int stale_readings_shown = 5;
// A controller's clock may be read a little before another part of the same sample.
constexpr double clock_slack_s = 0.5;
// The machine's clock went on so much further than ours between two readings: this computer slept.
constexpr double asleep_s = 20.0;      // machine
constexpr double asleep_wall_s = 5.0;  // on a quick machine jitter of ours is long
// A spindle that is off its speed by so much for so long does not follow the command.
constexpr double other_speed_share = 0.1;  // overrides are in steps of 10 %, drives keep 1 %
constexpr double other_speed_least_rpm = 50.0;
constexpr double spin_up_s = 60.0;  // machine; large spindles take half a minute

}  // namespace

std::string details_of(const Error& error) {
  const nlohmann::json details = {{"code", name_of(error.code)}, {"context", error.context}};
  return json_text(details);
}

Status Run::wait_for_link(const Error& error, double& waited_s, int attempt) {
  raise("link", error);
  m_link_was_lost = true;
  m_commanded_step.reset();  // the machine may have stopped by itself
  publish(RunPhase::link_lost);
  // Whoever asks to finish waits no longer than a glitch lasts.
  const bool finish = m_control.finish_requested() && attempt >= attempts_to_finish;
  if (finish || waited_s >= m_options.link_patience_s) return fail(error);
  const double pause_s = std::min(longest_pause_s, first_pause_s * static_cast<double>(1 << std::min(attempt, 10)));
  m_log.commit_before_waiting(pause_s);
  if (!m_clock.wait_for(Seconds(pause_s * m_options.time_factor), m_context.stop)) return cancelled();
  waited_s += pause_s;
  return {};
}

template <class Call>
auto Run::patiently(Call call) -> decltype(call()) {
  double waited_s = 0.0;
  for (int attempt = 0;; ++attempt) {
    auto result = call();
    if (result) {
      clear("link");
      return result;
    }
    if (!may_pass(result.error())) return result;
    ZD_CHECK(wait_for_link(result.error(), waited_s, attempt));
  }
}

Status Run::command(double spindle_rpm, bool coolant_on, bool path_cycle) {
  ZD_CHECK(patiently([&] { return m_machine.command(spindle_rpm, coolant_on, path_cycle); }));
  m_commanded_rpm = spindle_rpm;
  m_other_speed_since_s.reset();
  return {};
}

/// Another program or an operator commands the machine, or an override is turned: what is recorded is not the plan.
void Run::watch_speed(const MachineSample& sample) {
  if (!m_commanded_rpm) return;
  const double wanted_rpm = *m_commanded_rpm;
  const double allowed_rpm = std::max(other_speed_least_rpm, other_speed_share * wanted_rpm);
  if (!(std::abs(sample.spindle_rpm - wanted_rpm) > allowed_rpm)) {
    m_other_speed_since_s.reset();
    clear("speed");
    return;
  }
  if (!m_other_speed_since_s) m_other_speed_since_s = sample.machine_time_s;
  if (sample.machine_time_s - *m_other_speed_since_s < spin_up_s) return;
  raise("speed", {ErrorCode::data_does_not_fit,
                  {{"what", "the spindle's speed"},
                   {"found", fmt::format("{:.0f} rpm", sample.spindle_rpm)},
                   {"expected", fmt::format("{:.0f} rpm, as this run commanded", wanted_rpm)}}});
}

/// What a device of the rig fails to say is missing; the run goes on with the rest.
void Run::watch_devices(const MachineSample& sample) {
  for (const std::string& device : m_failing_devices) {
    if (!sample.device_faults.contains(device)) clear("device " + device);
  }
  m_failing_devices.clear();
  for (const auto& [device, fault] : sample.device_faults) {
    m_failing_devices.push_back(device);
    raise("device " + device, {ErrorCode::device_failing, {{"device", device}, {"reason", describe(fault)}}});
  }
}

Result<Stand> Run::come_to_measuring_position() {
  const auto& position_mm = m_start.plan.measure_position_mm;
  const auto move = [&] { return patiently([&] { return m_machine.move_to(position_mm); }); };
  ZD_TRY(Stand stand, come_to([this] { return read(); }, move, position_mm, m_host));
  stand.until = stand.since + Seconds(budget_share * m_start.plan.measure_period_s / m_options.time_factor);
  return stand;
}

Status Run::has_measuring_position(const MachineSample& sample) const {
  std::string open;
  for (const char* axis : {"X", "Y", "Z"}) {
    const bool there = sample.axes.contains(axis);
    if (there && !m_start.plan.measure_position_mm.contains(axis))
      open += (open.empty() ? "" : ", ") + std::string(axis);
  }
  if (m_start.plan.measure_position_mm.empty()) open = "X, Y, Z";
  if (open.empty()) return {};
  return fail(ErrorCode::no_measuring_position, {{"axes", open}});
}

Result<MachineSample> Run::read() {
  ZD_TRY(const MachineSample sample, patiently([&] { return m_machine.read(); }));
  ZD_CHECK(accept(sample));
  return sample;
}

Status Run::accept(const MachineSample& sample) {
  ZD_CHECK(m_options.guard(sample));
  if (sample.alarm) return fail(ErrorCode::machine_not_ready, {{"what", m_identity.name}, {"reason", "alarm"}});
  if (!sample.referenced) {
    return fail(ErrorCode::machine_not_ready, {{"what", m_identity.name}, {"reason", "axes are not referenced"}});
  }
  const Seconds now = m_clock.steady();
  if (m_has_reading) {
    const double time_s = sample.machine_time_s - m_start.origin_s;
    if (time_s < m_time_s - clock_slack_s) {
      clock_restarted(sample.machine_time_s, std::max(0.0, (now - m_read_at).count()));
    } else if (time_s <= m_time_s) {
      // The next row would not be after the last one: it is left out until the clock goes on.
      if (++m_stale_readings == stale_readings_shown) {
        raise("clock", {ErrorCode::machine_bad_reply, {{"what", "machine clock"}, {"detail", "stands still"}}});
      }
    } else {
      m_stale_readings = 0;
      clear("clock");
      note_sleep(time_s, (now - m_read_at).count());
    }
    m_time_s = std::max(m_time_s, sample.machine_time_s - m_start.origin_s);
  }
  m_read_at = now;
  watch_speed(sample);
  watch_devices(sample);
  if (m_options.each_sample) ZD_CHECK(m_options.each_sample(sample));
  return {};
}

// Our steady clock stands while the computer sleeps; the machine and its heat go on. The hole in the rows gets its
// name.
void Run::note_sleep(double time_s, double host_s) {
  if (time_s - m_time_s - host_s < std::max(asleep_s, asleep_wall_s * m_options.time_factor)) return;
  ++m_summary.gaps;
  m_commanded_step.reset();  // a controller whose host is silent may have stopped by itself
  event("gap", "asleep", json_text(nlohmann::json{{"from_s", m_time_s}, {"to_s", time_s}}));
}

// The machine was switched off and on: its clock began again, and while it was off the plan stood still.
void Run::clock_restarted(double machine_time_s, double gap_s) {
  m_start.origin_s = machine_time_s - (m_time_s + gap_s);
  m_paused_s += gap_s;
  m_commanded_step.reset();
  const nlohmann::json details = {{"origin_s", m_start.origin_s}, {"gap_s", gap_s}, {"paused_s", m_paused_s}};
  event("clock", "restarted", json_text(details));
}

}  // namespace zerodrift::acquisition
