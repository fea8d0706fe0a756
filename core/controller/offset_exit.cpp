#include "core/controller/offset_exit.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "core/acquisition/machine_fault.h"

namespace zerodrift::controller {
namespace {

using Offset = std::array<double, 3>;

constexpr double refusal_patience_s = 3.0;  // host: a refusal that is no fault of the link is asked about a few times

double largest_of(const Offset& offset_um) {
  double largest = 0.0;
  for (const double value : offset_um) largest = std::max(largest, std::abs(value));
  return largest;
}

class OffsetExit {
 public:
  OffsetExit(ModbusMachine& machine, const OffsetExitOptions& options)
      : m_machine(machine), m_options(options), m_held_um(options.last_um) {}

  Status run(const std::string& reason) {
    const Status out = take_out();
    const Status off = m_options.switch_off ? m_machine.switch_compensation(false) : Status();
    if (out && off) return {};
    const std::string detail = describe(out ? off.error() : out.error());
    return fail(ErrorCode::compensation_left,
                {{"reason", reason}, {"detail", detail}, {"held", held_text()}, {"switch", switch_text()}});
  }

 private:
  static double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
  }

  Status take_out() {
    double least_um = std::numeric_limits<double>::infinity();
    double progress_s = now_s() - m_options.without_machine_s;
    double last_s = now_s() - m_options.pause_s;
    for (;;) {
      const double passed_s = now_s() - last_s;
      const Status done = step(passed_s);
      if (m_options.observer) m_options.observer(m_held_um.value_or(Offset{}), done);
      if (done) {
        last_s += passed_s;
        if (is_zero(*m_held_um)) return {};
        if (largest_of(*m_held_um) < least_um) progress_s = now_s();
        least_um = std::min(least_um, largest_of(*m_held_um));
      }
      const bool passing = done || acquisition::may_pass(done.error());
      const double patience_s = passing ? m_options.patience_s : std::min(m_options.patience_s, refusal_patience_s);
      if (now_s() - progress_s > patience_s) return done ? not_taken() : done;
      std::this_thread::sleep_for(std::chrono::duration<double>(m_options.pause_s));
    }
  }

  static Status not_taken() {
    return fail(ErrorCode::machine_not_ready,
                {{"what", "taking the offset out"}, {"reason", "the controller keeps the offset"}});
  }

  /// Nothing is left to do when the controller holds 0.
  Status step(double passed_s) {
    ZD_TRY(m_held_um, m_machine.held_offset_um());
    if (is_zero(*m_held_um)) return {};
    if (m_options.may_write) ZD_CHECK(m_options.may_write());
    ZD_TRY(const bool on, m_machine.compensation_on());
    // Nothing is applied now; what is held must not come with the next time the switch is turned on.
    if (!on) return m_machine.clear_host_offset();
    const double step_um =
        std::min(m_options.rate_um_s * m_machine.profile().time_factor * passed_s, m_machine.map().host_offset_step_um);
    for (std::size_t i = 0; i < m_way_um.size(); ++i) {
      // From what was asked for, where the register rounds; from what is held, where the controller took out more.
      const double held_um = (*m_held_um)[i];
      const double from_um = std::copysign(std::min(std::abs(held_um), m_way_um[i]), held_um);
      m_next_um[i] = from_um - std::clamp(from_um, -step_um, step_um);
    }
    ZD_CHECK(m_machine.write_host_offset(m_next_um));
    for (std::size_t i = 0; i < m_way_um.size(); ++i) m_way_um[i] = std::abs(m_next_um[i]);
    return {};
  }

  std::string held_text() {
    if (const auto held = m_machine.held_offset_um()) return text_of_offset(*held);
    if (!m_held_um) return "unknown";
    return "unknown, last read " + text_of_offset(*m_held_um);
  }

  std::string switch_text() {
    const auto on = m_machine.compensation_on();
    return !on ? "unknown" : *on ? "on" : "off";
  }

  ModbusMachine& m_machine;
  const OffsetExitOptions& m_options;
  std::optional<Offset> m_held_um;
  Offset m_next_um{};
  Offset m_way_um{1e9, 1e9, 1e9};  // sizes of what was asked for last
};

}  // namespace

Status leave_without_offset(ModbusMachine& machine, const OffsetExitOptions& options, const std::string& reason) {
  return OffsetExit(machine, options).run(reason);
}

std::string text_of_offset(const std::array<double, 3>& offset_um) {
  return fmt::format("X {:.1f}, Y {:.1f}, Z {:.1f} um", offset_um[0], offset_um[1], offset_um[2]);
}

bool is_zero(const std::array<double, 3>& offset_um) {
  return std::all_of(offset_um.begin(), offset_um.end(), [](double value) { return value == 0.0; });
}

}  // namespace zerodrift::controller
