#include "app/machine/truth_log.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <iterator>
#include <string>

namespace zerodrift::machine {
namespace {

constexpr double period_s = 2.0;

std::string header() {
  std::string line =
      "time_s,dX_um,dY_um,dZ_um,thermal_dX_um,thermal_dY_um,thermal_dZ_um,tilt_X_urad,tilt_Y_urad,"
      "applied_X_um,applied_Y_um,applied_Z_um,front_camera_drift_right_um,front_camera_drift_up_um,"
      "front_camera_roll_urad,front_camera_scale_ppm,side_camera_drift_right_um,side_camera_drift_up_um,"
      "side_camera_roll_urad,side_camera_scale_ppm,X_mm,Y_mm,Z_mm,spindle_rpm,spindle_load_W,coolant_on,"
      "compensation_on,spindle_growth_um,ambient_C";
  for (int sensor = 1; sensor <= sensor_count; ++sensor) line += fmt::format(",T{}_C", sensor);
  return line + "\n";
}

std::string row(const Machine& machine, double time_s) {
  std::string line = fmt::format("{:.0f}", time_s);
  const auto out = std::back_inserter(line);
  const auto add = [&](double value) { fmt::format_to(out, ",{:.4f}", value); };
  const ThermalModel& thermal = machine.thermal();
  for (const double error : machine.true_error_um()) add(error);
  for (const double error : thermal.errors().um) add(error);
  for (const double tilt : thermal.errors().urad) add(tilt);
  for (int axis = 0; axis < linear_axes; ++axis) add(machine.compensator().applied_um(axis));
  for (const View view : {View::front, View::side}) {
    const CameraScene scene = machine.scene(view);
    add(scene.camera_drift_right_um);
    add(scene.camera_drift_up_um);
    add(scene.camera_roll_urad);
    add(scene.camera_scale_ppm);
  }
  for (const double position : machine.motion().position_mm()) add(position);
  add(machine.speed_rpm());
  add(machine.spindle_load_W());
  fmt::format_to(out, ",{},{}", machine.coolant_on() ? 1 : 0, machine.compensator().is_on() ? 1 : 0);
  add(thermal.spindle_growth_um());
  add(thermal.room_C());
  for (const double temperature : thermal.sensor_C()) add(temperature);
  return line + "\n";
}

}  // namespace

Status TruthLog::open(const std::filesystem::path& path) {
  m_file.open(path, std::ios::trunc);
  if (!m_file) {
    return fail(ErrorCode::file_not_writable, {{"file", path.string()}, {"detail", std::strerror(errno)}});
  }
  m_file << header();
  return {};
}

void TruthLog::moment(const Machine& machine) {
  if (!m_file.is_open() || machine.time_s() < m_next_s) return;
  // after a pause of the host the machine has moved on by more than a period: one row, of now
  const double time_s = std::floor(machine.time_s() / period_s) * period_s;
  m_file << row(machine, time_s);
  m_next_s = time_s + period_s;
  const auto now = std::chrono::steady_clock::now();
  if (now - m_flushed < std::chrono::seconds(1)) return;
  m_flushed = now;
  m_file.flush();
}

void TruthLog::close() {
  if (m_file.is_open()) m_file.close();
}

}  // namespace zerodrift::machine
