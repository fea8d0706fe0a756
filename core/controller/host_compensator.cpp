#include "core/controller/host_compensator.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/acquisition/machine_fault.h"
#include "core/compensation/interlock.h"
#include "core/controller/active_table.h"
#include "core/controller/offset_exit.h"

namespace zerodrift::controller {
namespace {

class Loop {
 public:
  Loop(ModbusMachine& machine, const compensation::Table& table, const HostCompensatorOptions& options,
       const TaskContext& context, const std::function<void(const CompensatorTurn&)>& observer)
      : m_machine(machine),
        m_options(options),
        m_context(context),
        m_observer(observer),
        m_follower(table, follower_options(machine, options), options.predictor) {}

  Result<CompensatorSummary> run() {
    ZD_CHECK(prepare());
    const Status worked = without_throwing([this] { return follow(); });
    const std::string reason = worked ? "it was stopped" : describe(worked.error());
    const Status left = without_throwing([&] { return leave(reason); });
    if (!left) return fail(left.error());
    if (worked) return m_summary;
    const auto on = m_machine.compensation_on();
    return fail(ErrorCode::compensation_ended, {{"reason", reason}, {"switch", !on ? "unknown" : *on ? "on" : "off"}});
  }

 private:
  static compensation::FollowerOptions follower_options(const ModbusMachine& machine,
                                                        const HostCompensatorOptions& options) {
    compensation::FollowerOptions out = options.follower;
    out.largest_step_um = std::min(out.largest_step_um, machine.map().host_offset_step_um);
    return out;
  }

  /// Refusals before anything is written.
  Status prepare() {
    ZD_CHECK(m_machine.may_write("Compensating"));
    ZD_TRY(const auto identity, patiently([this] { return m_machine.identify(); }));
    if (!identity.accepts_host_offset) {
      return fail(ErrorCode::machine_unsupported,
                  {{"what", "the host offset"}, {"found", "none"}, {"expected", "one to write to"}});
    }
    if (identity.accepts_table) ZD_CHECK(patiently([this] { return refuse_active_table(); }));
    ZD_TRY(m_was_on, patiently([this] { return m_machine.compensation_on(); }));
    return m_was_on || m_options.switch_on ? Status() : compensation::allow_offset_write(false);
  }

  /// Asked again while the fault may pass by itself.
  template <class Call>
  auto patiently(Call call) -> decltype(call()) {
    const double end_s = m_clock.steady().count() + m_options.give_up_s;
    for (;;) {
      auto answer = call();
      const bool again = !answer && acquisition::may_pass(answer.error()) && m_clock.steady().count() < end_s;
      if (!again || m_context.cancelled()) return answer;
      m_clock.wait_for(Seconds(std::min(m_options.period_s, 0.2)), m_context.stop);
    }
  }

  Status refuse_active_table() {
    ZD_TRY(const ActiveTable active, read_active(m_machine));
    if (is_empty_table(active.words.size())) return {};
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the controller's own table"},
                 {"found", fmt::format("an active one (version {}) that compensates already", active.sequence)},
                 {"expected", "none beside the host compensator; roll it back first"}});
  }

  /// What an earlier end without an exit left in the registers would move the axes with the switch.
  Status turn_on() {
    const auto held = [this] { return m_machine.held_offset_um(); };
    ZD_TRY(auto held_um, patiently(held));
    const double end_s = m_clock.steady().count() + m_machine.host_seconds(60.0);
    while (!is_zero(held_um)) {
      const Status cleared = m_machine.clear_host_offset();
      if (!cleared && !acquisition::may_pass(cleared.error())) return cleared;
      m_clock.wait_for(Seconds(0.1), m_context.stop);
      ZD_TRY(held_um, patiently(held));
      if (m_clock.steady().count() > end_s || m_context.cancelled()) break;
    }
    if (!is_zero(held_um)) {
      return fail(
          ErrorCode::machine_not_ready,
          {{"what", "compensating"}, {"reason", "the controller holds an offset already: " + text_of_offset(held_um)}});
    }
    m_turned_on = true;
    return m_machine.switch_compensation(true);
  }

  Status follow() {
    if (!m_was_on) ZD_CHECK(turn_on());
    m_last_good_s = m_clock.steady().count();
    double next = m_last_good_s;
    while (!ending()) {
      const double late_s = m_clock.steady().count() - next;
      ZD_CHECK(turn(late_s));
      // A turn that came more than a period late is not made up for: the schedule begins anew.
      next += m_options.period_s + (late_s > m_options.period_s ? late_s : 0.0);
      m_clock.wait_until(Seconds(next), m_context.stop);
    }
    return {};
  }

  bool ending() const {
    if (m_context.cancelled()) return true;
    return m_options.duration_s && m_clock.steady().count() >= *m_options.duration_s;
  }

  /// One turn. A lost link is not the end: the controller's watchdog takes the offset out, and we come back.
  Status turn(double late_s) {
    m_summary.lateness.add(late_s);
    if (late_s > 0.5 * m_options.period_s) ++m_summary.late_turns;
    ++m_summary.turns;
    CompensatorTurn report;
    report.late_s = late_s;
    Status done = exchange(report);
    if (done) {
      m_last_good_s = m_clock.steady().count();
    } else {
      ++m_summary.lost_turns;
      report.link_lost = true;
      report.fault = done.error();
      if (!acquisition::may_pass(done.error()) || without_machine_s() > m_options.give_up_s) return done;
    }
    if (m_observer) m_observer(report);
    return {};
  }

  double without_machine_s() const { return m_clock.steady().count() - m_last_good_s; }

  /// Temperatures, and the inputs a model that remembers may want, in the recording's names.
  std::map<std::string, double> channels_of(const acquisition::MachineSample& sample) const {
    std::map<std::string, double> channels{{"ambient_C", sample.ambient_C},
                                           {"spindle_rpm", sample.spindle_rpm},
                                           {"spindle_load_W", sample.spindle_load_W},
                                           {"coolant_on", sample.coolant_on ? 1.0 : 0.0}};
    for (const auto& [axis, feed] : sample.feed_mm_min) channels["feed_" + axis + "_mm_min"] = feed;
    const auto& sensors = m_machine.profile().sensors;
    for (std::size_t i = 0; i < sensors.size(); ++i) channels[sensors[i].channel] = sample.temperature_C[i];
    return channels;
  }

  Status exchange(CompensatorTurn& report) {
    ZD_TRY(const auto sample, m_machine.read());
    const std::map<std::string, double> channels = channels_of(sample);
    const bool has_clock = std::isfinite(sample.machine_time_s);
    report.machine_time_s =
        has_clock ? sample.machine_time_s : m_clock.steady().count() * m_machine.profile().time_factor;
    report.axes = sample.axes;
    report.moving = sample.moving || sample.cycling;
    report.applied_um = sample.applied_um;
    report.switch_on = sample.compensation_on;
    if (!sample.compensation_on) {
      report.output.reasons.emplace_back("the compensation switch is off");
      return {};
    }
    // The controller's own value counts: its watchdog or switch may have taken the offset out since the last turn.
    const bool beats = m_machine.map().find("heartbeat") != nullptr;
    ZD_TRY(const RegisterValues held,
           beats ? m_machine.read_values({"host_offset_um", "heartbeat"}) : m_machine.read_values({"host_offset_um"}));
    if (beats) ZD_CHECK(hear(held.at("heartbeat").front()));
    const auto& values = held.at("host_offset_um");
    const std::array<double, 3> offset_um{values.at(0), values.at(1), values.at(2)};
    m_held_um = offset_um;
    watch_applied(sample, offset_um, report);
    m_follower.start_from(offset_um);
    auto reasons = std::move(report.output.reasons);
    report.output = m_follower.step(report.machine_time_s, channels, sample.axes);
    report.output.reasons.insert(report.output.reasons.end(), reasons.begin(), reasons.end());
    for (std::size_t i = 0; i < 3; ++i) {
      m_summary.largest_offset_um[i] = std::max(m_summary.largest_offset_um[i], std::abs(report.output.offset_um[i]));
    }
    const Status written = m_machine.write_host_offset(report.output.offset_um);
    if (!written && written.error().code == ErrorCode::interlock_compensation_off) return {};  // turned off just now
    ZD_CHECK(written);
    m_held_um = report.output.offset_um;
    return {};
  }

  /// What the controller applies must be what it was given: anything else is another compensation, or a wrong map.
  void watch_applied(const acquisition::MachineSample& sample, const std::array<double, 3>& offset_um,
                     CompensatorTurn& report) {
    std::size_t worst = 0;
    const auto beside_um = [&](std::size_t axis) { return std::abs(sample.applied_um[axis] - offset_um[axis]); };
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (beside_um(axis) > beside_um(worst)) worst = axis;
    }
    if (!(beside_um(worst) > m_options.foreign_um)) {
      m_foreign_since_s.reset();
      return;
    }
    if (!m_foreign_since_s) m_foreign_since_s = sample.machine_time_s;
    if (sample.machine_time_s - *m_foreign_since_s < m_options.foreign_s) return;
    report.foreign = true;
    report.output.reasons.push_back(
        fmt::format("the controller applies {:.1f} um in {} where {:.1f} um was written: something else compensates",
                    sample.applied_um[worst], "XYZ"[worst], offset_um[worst]));
  }

  /// A controller that answers but no longer beats has stopped: what it says is old, and it applies what it likes.
  Status hear(double beat) {
    const double now_s = m_clock.steady().count();
    if (!m_beat || beat != *m_beat) {
      m_beats = m_beats || m_beat.has_value();
      m_beat = beat;
      m_beat_s = now_s;
      return {};
    }
    const double silence_s = std::max(m_options.silence_s, 3.0 * m_options.period_s);
    if (!m_beats || now_s - m_beat_s <= silence_s) return {};
    return fail(ErrorCode::machine_silent,
                {{"what", "its heartbeat"}, {"timeout_ms", fmt::format("{:.0f}", 1e3 * (now_s - m_beat_s))}});
  }

  Status leave(const std::string& reason) {
    OffsetExitOptions exit;
    exit.rate_um_s = m_follower.slowest_rate_um_s();
    exit.patience_s = m_options.give_up_s;
    exit.without_machine_s = m_held_um ? without_machine_s() : 0.0;
    exit.pause_s = std::min(m_options.period_s, 0.2);
    exit.switch_off = m_turned_on;
    exit.last_um = m_held_um;
    exit.may_write = [this]() -> Status {
      if (m_machine.map().find("heartbeat") == nullptr) return {};
      ZD_TRY(const double beat, m_machine.read_value("heartbeat"));
      return hear(beat);
    };
    exit.observer = [this](const auto& held_um, const Status& done) { tell_exit(held_um, done); };
    return leave_without_offset(m_machine, exit, reason);
  }

  void tell_exit(const std::array<double, 3>& held_um, const Status& done) {
    if (!m_observer) return;
    CompensatorTurn report;
    report.machine_time_s = std::nan("");
    report.output.mode = compensation::FollowerMode::stopping;
    report.output.offset_um = held_um;
    report.link_lost = !done;
    if (!done) report.fault = done.error();
    if (const auto sample = done ? m_machine.read() : Result<acquisition::MachineSample>(fail(done.error()))) {
      report.machine_time_s = sample->machine_time_s;
      report.axes = sample->axes;
      report.moving = sample->moving;
      report.applied_um = sample->applied_um;
      report.switch_on = sample->compensation_on;
    }
    // An observer that throws must not keep the offset in the machine.
    static_cast<void>(without_throwing([&]() -> Status {
      m_observer(report);
      return {};
    }));
  }

  ModbusMachine& m_machine;
  const HostCompensatorOptions& m_options;
  const TaskContext& m_context;
  const std::function<void(const CompensatorTurn&)>& m_observer;
  compensation::Follower m_follower;
  SystemClock m_clock;
  CompensatorSummary m_summary;
  bool m_was_on = false;
  bool m_turned_on = false;
  double m_last_good_s = 0.0;
  std::optional<std::array<double, 3>> m_held_um;  // by the controller, as last read or written
  std::optional<double> m_foreign_since_s;         // machine time
  std::optional<double> m_beat;                    // the controller's, as last read
  double m_beat_s = 0.0;                           // when it changed
  bool m_beats = false;                            // it has been seen to change
};

}  // namespace

void Lateness::add(double late_s) {
  const double last = static_cast<double>(m_bins.size() - 1);
  ++m_bins[static_cast<std::size_t>(std::clamp(std::floor(1e3 * late_s), 0.0, last))];
  ++m_count;
  m_largest_s = std::max(m_largest_s, late_s);
}

double Lateness::quantile_s(double share) const {
  const double wanted = share * static_cast<double>(m_count);
  long below = 0;
  for (std::size_t i = 0; i + 1 < m_bins.size(); ++i) {
    below += m_bins[i];
    if (static_cast<double>(below) >= wanted) return std::min(m_largest_s, 1e-3 * static_cast<double>(i + 1));
  }
  return m_largest_s;
}

long Lateness::above(double late_s) const {
  long later = 0;
  for (std::size_t i = m_bins.size(); i-- > 0 && 1e-3 * static_cast<double>(i) >= late_s - 1e-9;) later += m_bins[i];
  return later;
}

Result<CompensatorSummary> run_host_compensator(ModbusMachine& machine, const compensation::Table& table,
                                                const HostCompensatorOptions& options, const TaskContext& context,
                                                const std::function<void(const CompensatorTurn&)>& observer) {
  return Loop(machine, table, options, context, observer).run();
}

}  // namespace zerodrift::controller
