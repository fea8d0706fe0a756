#pragma once
// What the controller does with the table and the host's offset: switch with ramp, clamp, rate limit, watchdog.

#include <array>
#include <cstdint>

#include "app/machine/compensation_table.h"
#include "app/machine/motion.h"

namespace zerodrift::machine {

enum class OffsetState : std::uint16_t {
  none = 0,
  active = 1,
  watchdog_ran_out = 2,
};

class Compensator {
 public:
  void advance(double duration_s, const Motion& motion, const TableTemperatures& temperature_C);

  void switch_to(bool on);
  bool is_on() const { return m_on; }
  double ramp() const { return m_ramp; }  // 0 to 1
  /// Compensation in the axes now, host offset included.
  double applied_um(int axis) const { return m_limited_um[axis] * m_ramp + m_offset_um[axis]; }

  /// Allowed only while the switch is off; the table store sees to that.
  void activate(CompensationTable table) { m_table = std::move(table); }
  /// What a table would ask for at this state, clamped.
  static Axes asked_um(const CompensationTable& table, const Motion& motion, const TableTemperatures& temperature_C);
  const CompensationTable& table() const { return m_table; }

  /// False: beyond the limit or too large a step.
  bool offset_allowed(int axis, double offset_um) const;
  void write_offset(int axis, double offset_um);
  double offset_um(int axis) const { return m_offset_um[axis]; }
  OffsetState offset_state() const { return m_offset_state; }
  void host_beat();
  double watchdog_s = 10.0;

 private:
  void advance_offset(double duration_s);

  CompensationTable m_table;
  bool m_on = false;
  double m_ramp = 0.0;
  Axes m_limited_um{};
  Axes m_rate_um_s{};  // of the last table that had the axis: an axis that left the table returns to 0 at it
  Axes m_offset_um{};
  double m_offset_fall_um_s = 0.0;  // while it goes to 0
  OffsetState m_offset_state = OffsetState::none;
  double m_since_beat_s = 0.0;
};

}  // namespace zerodrift::machine
