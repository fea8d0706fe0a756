#include "core/controller/host_compensator.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "core/compensation/interlock.h"
#include "core/controller/upload.h"

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
    ZD_TRY(const bool on, m_machine.compensation_on());
    ZD_CHECK(compensation::allow_offset_write(on));
    double next = m_clock.steady().count();
    while (!ending()) {
      const double late_s = m_clock.steady().count() - next;
      ZD_CHECK(turn(late_s));
      // A turn that came more than a period late is not made up for: the schedule begins anew.
      next += m_options.period_s + (late_s > m_options.period_s ? late_s : 0.0);
      m_clock.wait_until(Seconds(next), m_context.stop);
    }
    ZD_CHECK(run_to_zero());
    return m_summary;
  }

 private:
  static compensation::FollowerOptions follower_options(const ModbusMachine& machine,
                                                        const HostCompensatorOptions& options) {
    compensation::FollowerOptions out = options.follower;
    out.largest_step_um = std::min(out.largest_step_um, machine.map().host_offset_step_um);
    return out;
  }

  Status prepare() {
    ZD_TRY(const auto identity, m_machine.identify());
    if (!identity.accepts_host_offset) {
      return fail(ErrorCode::machine_unsupported,
                  {{"what", "the host offset"}, {"found", "none"}, {"expected", "one to write to"}});
    }
    if (!identity.accepts_table) return {};
    ZD_TRY(const ActiveTable active, read_active(m_machine));
    if (active.words.size() <= 2) return {};
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the controller's own table"},
                 {"found", fmt::format("an active one (version {}) that compensates already", active.sequence)},
                 {"expected", "none beside the host compensator; roll it back first"}});
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
      if (!is_link_error(done.error()) || m_clock.steady().count() - m_last_good_s > m_options.give_up_s) return done;
    }
    if (m_observer) m_observer(report);
    return {};
  }

  static bool is_link_error(const Error& error) {
    switch (error.code) {
      case ErrorCode::machine_unreachable:
      case ErrorCode::machine_silent:
      case ErrorCode::machine_link_lost:
      case ErrorCode::machine_bad_reply:
      case ErrorCode::machine_busy:
        return true;
      default:
        return false;
    }
  }

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
    report.machine_time_s = sample.machine_time_s;
    report.axes = sample.axes;
    report.moving = sample.moving;
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
    watch_applied(sample, offset_um, report);
    m_follower.start_from(offset_um);
    auto reasons = std::move(report.output.reasons);
    report.output = m_follower.step(sample.machine_time_s, channels, sample.axes);
    report.output.reasons.insert(report.output.reasons.end(), reasons.begin(), reasons.end());
    for (std::size_t i = 0; i < 3; ++i) {
      m_summary.largest_offset_um[i] = std::max(m_summary.largest_offset_um[i], std::abs(report.output.offset_um[i]));
    }
    return m_machine.write_host_offset(report.output.offset_um);
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

  Status run_to_zero() {
    m_follower.stop();
    const double end_s = m_clock.steady().count() + m_machine.host_seconds(600.0);
    while (!m_follower.at_zero() && m_clock.steady().count() < end_s) {
      ZD_CHECK(turn(0.0));
      m_clock.wait_for(Seconds(std::min(m_options.period_s, 0.2)), {});
    }
    return {};
  }

  ModbusMachine& m_machine;
  const HostCompensatorOptions& m_options;
  const TaskContext& m_context;
  const std::function<void(const CompensatorTurn&)>& m_observer;
  compensation::Follower m_follower;
  SystemClock m_clock;
  CompensatorSummary m_summary;
  double m_last_good_s = 0.0;
  std::optional<double> m_foreign_since_s;  // machine time
  std::optional<double> m_beat;             // the controller's, as last read
  double m_beat_s = 0.0;                    // when it changed
  bool m_beats = false;                     // it has been seen to change
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
