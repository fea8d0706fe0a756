#include "app/machine/compensator.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace zerodrift::machine {
namespace {

constexpr double ramp_s = 20.0;
constexpr double largest_offset_step_um = 20.0;
constexpr double watchdog_fall_um_s = 2.0;

}  // namespace

Axes Compensator::asked_um(const CompensationTable& table, const Motion& motion,
                           const TableTemperatures& temperature_C) {
  Axes asked{};
  for (const AxisRecord& record : table) {
    const double position_mm = motion.position_mm()[record.axis];
    asked[record.axis] = evaluate(record, position_mm, motion.upwards(record.axis), temperature_C);
  }
  return asked;
}

void Compensator::advance(double duration_s, const Motion& motion, const TableTemperatures& temperature_C) {
  const Axes asked = asked_um(m_table, motion, temperature_C);
  for (const AxisRecord& record : m_table) m_rate_um_s[record.axis] = record.rate_um_s;
  const bool silent = m_ramp == 0.0;  // nothing is applied: the ramp alone makes the beginning smooth
  for (int axis = 0; axis < linear_axes; ++axis) {
    const double reach = silent ? largest_compensation_um * 2 : m_rate_um_s[axis] * duration_s;
    m_limited_um[axis] += std::clamp(asked[axis] - m_limited_um[axis], -reach, reach);
  }
  m_ramp = std::clamp(m_ramp + (m_on ? duration_s : -duration_s) / ramp_s, 0.0, 1.0);
  advance_offset(duration_s);
}

void Compensator::advance_offset(double duration_s) {
  m_since_beat_s += duration_s;
  if (m_offset_state == OffsetState::active && m_on && m_since_beat_s > watchdog_s) {
    m_offset_state = OffsetState::watchdog_ran_out;
    m_offset_fall_um_s = watchdog_fall_um_s;
  }
  if (m_offset_fall_um_s == 0.0) return;
  bool all_zero = true;
  for (double& offset : m_offset_um) {
    const double reach = m_offset_fall_um_s * duration_s;
    offset -= std::clamp(offset, -reach, reach);
    all_zero = all_zero && offset == 0.0;
  }
  if (all_zero) m_offset_fall_um_s = 0.0;
}

void Compensator::switch_to(bool on) {
  if (on == m_on) return;
  m_on = on;
  if (on) return;
  double largest = 0.0;
  for (const double offset : m_offset_um) largest = std::max(largest, std::abs(offset));
  m_offset_fall_um_s = largest / ramp_s;
  m_offset_state = OffsetState::none;
}

bool Compensator::offset_allowed(int axis, double offset_um) const {
  return std::isfinite(offset_um) && std::abs(offset_um) <= largest_compensation_um &&
         std::abs(offset_um - m_offset_um[axis]) <= largest_offset_step_um;
}

void Compensator::write_offset(int axis, double offset_um) {
  // a first offset opens the watch; later ones need the host's heartbeat to have moved in time
  if (m_offset_state != OffsetState::active) m_since_beat_s = 0.0;
  m_offset_um[axis] = offset_um;
  m_offset_fall_um_s = 0.0;
  m_offset_state = OffsetState::active;
}

void Compensator::host_beat() {
  m_since_beat_s = 0.0;
}

}  // namespace zerodrift::machine
