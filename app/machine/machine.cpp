#include "app/machine/machine.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::machine {
namespace {

constexpr double longest_step_s = 0.1;
constexpr double spindle_rpm_per_s = 1500.0;
// Low pass of the temperatures that the table sees: without it a reading's noise times um/K would shake the axes.
constexpr double filter_s = 10.0;
constexpr double probe_lever_mm = 100.0;
constexpr double nest_reach_mm = 0.5;
// The cameras' aluminium bracket, 100 mm long, follows the room and warms with the camera itself.
constexpr double bracket_um_per_K = 2.3;
constexpr double bracket_memory_s = 1500.0;
constexpr double camera_self_heat_K = 1.2;
constexpr double wander_sigma_um = 0.25;
constexpr double bracket_wander_memory_s = 900.0;
// It is warmer on the camera's side, so it bends; and it brings the camera nearer.
constexpr double roll_urad_per_K = 80.0;
constexpr double scale_ppm_per_K = 40.0;
constexpr double roll_wander_urad = 10.0;
constexpr double scale_wander_ppm = 5.0;

}  // namespace

Machine::Machine(const MachineParameters& parameters)
    : m_parameters(parameters),
      m_thermal(m_parameters),
      m_board(m_parameters),
      m_bracket_noise(m_parameters.seed * 7919 + 3),
      m_turn_noise(m_parameters.seed * 7919 + 5) {
  convert_temperatures();
}

void Machine::advance_to(double time_s) {
  while (m_time_s < time_s) {
    const double thermal_due = m_thermal.time_s() + ThermalModel::step_s;
    const double conversion_due = static_cast<double>(m_conversions + 1);
    const double next = std::min({time_s, m_time_s + longest_step_s, thermal_due, conversion_due});
    advance_step(next - m_time_s);
    m_time_s = next;
    if (next >= thermal_due) advance_thermal();
    if (next >= conversion_due) convert_temperatures();
  }
}

void Machine::advance_step(double duration_s) {
  const double reach = spindle_rpm_per_s * duration_s;
  m_speed_rpm += std::clamp(m_commanded_rpm - m_speed_rpm, -reach, reach);
  if (m_speed_rpm > 0.0 && !m_first_turn_s) m_first_turn_s = m_time_s;
  m_speed_sum += m_speed_rpm * duration_s;
  if (m_motion.cycling()) m_cycle_sum_s += duration_s;
  m_motion.advance(duration_s);
  m_table_store.advance(duration_s, m_compensator, m_motion, m_filtered_C);
  m_compensator.advance(duration_s, m_motion, m_filtered_C);
}

void Machine::advance_thermal() {
  constexpr double step_s = ThermalModel::step_s;
  MachineInputs inputs;
  inputs.speed_rpm = m_speed_sum / step_s;
  inputs.coolant_on = m_coolant_on;
  inputs.cutting_W = inputs.speed_rpm > 1.0 ? m_cutting_W : 0.0;
  inputs.cycle = m_cycle_sum_s > step_s / 2;
  for (int axis = 0; axis < linear_axes; ++axis) {
    inputs.feed_mm_min[axis] = (m_motion.way_mm(axis) - m_way_at_step_mm[axis]) / step_s * 60.0;
    m_way_at_step_mm[axis] = m_motion.way_mm(axis);
  }
  m_speed_sum = 0.0;
  m_cycle_sum_s = 0.0;
  m_thermal.step(inputs);
  advance_cameras();
}

void Machine::advance_cameras() {
  constexpr double step_s = ThermalModel::step_s;
  const double goal_K = m_thermal.room_C() - m_parameters.room_start_C + camera_self_heat_K;
  m_bracket_K += (goal_K - m_bracket_K) * (1.0 - std::exp(-step_s / bracket_memory_s));
  const double memory = std::exp(-step_s / bracket_wander_memory_s);
  const double fresh = std::sqrt(1.0 - memory * memory);
  for (double& wander : m_bracket_wander_um) {
    wander = memory * wander + wander_sigma_um * fresh * m_bracket_noise.normal();
  }
  for (std::size_t view = 0; view < view_count; ++view) {
    double& roll_urad = m_roll_wander_urad[view];
    double& scale_ppm = m_scale_wander_ppm[view];
    roll_urad = memory * roll_urad + roll_wander_urad * fresh * m_turn_noise.normal();
    scale_ppm = memory * scale_ppm + scale_wander_ppm * fresh * m_turn_noise.normal();
  }
}

void Machine::convert_temperatures() {
  ++m_conversions;
  const auto second = static_cast<std::uint64_t>(m_conversions);
  const bool first = m_conversions == 0;
  const bool spell = m_sensor_fault.always || m_conversions % 1800 >= 1200;  // sporadic: ten minutes of thirty
  for (int sensor = 0; sensor <= sensor_count; ++sensor) {
    const bool ill = m_sensor_fault.kind != SensorFault::Kind::none && sensor == m_sensor_fault.sensor && spell;
    if (ill && m_sensor_fault.kind == SensorFault::Kind::dead) {
      m_raw[sensor] = dead_reading;
      continue;  // the controller goes on with the last good temperature
    }
    if (!ill || first) {
      const double true_C = sensor == 0 ? m_thermal.room_C() : m_thermal.sensor_C()[sensor - 1];
      m_raw[sensor] = m_board.reading(sensor, true_C, second);
    }
    const double shown_C = m_raw[sensor] / 16.0;
    m_filtered_C[sensor] = first ? shown_C : m_filtered_C[sensor] + (shown_C - m_filtered_C[sensor]) / filter_s;
  }
}

Axes Machine::true_error_um() const {
  Axes error = m_thermal.errors().um;
  for (int axis = 0; axis < linear_axes; ++axis) {
    error[axis] += geometric_error_um(axis, m_motion.position_mm()[axis], m_motion.upwards(axis));
    error[axis] += m_compensator.applied_um(axis);
  }
  return error;
}

bool Machine::at_nest() const {
  const Axes& at = m_motion.position_mm();
  return std::all_of(at.begin(), at.end(), [](double mm) { return std::abs(mm) <= nest_reach_mm; });
}

std::array<double, 5> Machine::probes_um() const {
  Axes seen = true_error_um();
  for (int axis = 0; axis < linear_axes; ++axis) seen[axis] += m_motion.position_mm()[axis] * 1000.0;
  const auto& tilt = m_thermal.errors().urad;
  // turning about X moves the upper ring in -Y, turning about Y moves it in +X
  const double lever_m = probe_lever_mm / 1000.0;
  return {seen[0], seen[0] + tilt[1] * lever_m, seen[1], seen[1] - tilt[0] * lever_m, seen[2]};
}

CameraScene Machine::scene(View view) const {
  const Axes error = true_error_um();
  const int across = view == View::front ? 0 : 1;
  const auto seen = [&](int axis) { return m_motion.position_mm()[axis] * 1000.0 + error[axis]; };
  CameraScene scene;
  scene.target_right_um = seen(across);
  scene.target_up_um = seen(2);
  scene.roll_urad = view == View::front ? -m_thermal.errors().urad[1] : m_thermal.errors().urad[0];
  scene.machine_time_s = m_time_s;
  scene.camera_drift_right_um = -0.4 * bracket_um_per_K * m_bracket_K + m_bracket_wander_um[across];
  scene.camera_drift_up_um = bracket_um_per_K * m_bracket_K + m_bracket_wander_um[2];
  const std::size_t camera = view == View::front ? 0 : 1;
  scene.camera_roll_urad = roll_urad_per_K * m_bracket_K + m_roll_wander_urad[camera];
  scene.camera_scale_ppm = scale_ppm_per_K * m_bracket_K + m_scale_wander_ppm[camera];
  return scene;
}

}  // namespace zerodrift::machine
