#include "core/controller/devices/manual_control.h"

#include <fmt/format.h>

#include <cmath>

#include "core/compensation/interlock.h"

namespace zerodrift::controller {

std::string_view name_of(OperatorAct act) {
  switch (act) {
    case OperatorAct::state:
      return "state";
    case OperatorAct::command:
      return "command";
    case OperatorAct::move:
      return "move";
    case OperatorAct::switch_compensation:
      return "switch_compensation";
    case OperatorAct::offset:
      return "offset";
    case OperatorAct::load_table:
      return "load_table";
    case OperatorAct::check_table:
      return "check_table";
  }
  return "";
}

Result<std::unique_ptr<ManualControl>> ManualControl::open(const Profile& profile, std::shared_ptr<Operator> person,
                                                           access::Permit permit) {
  if (!person) return fail(ErrorCode::operator_missing);
  auto control = std::unique_ptr<ManualControl>(new ManualControl(profile, std::move(person), permit));
  ZD_TRY(control->m_devices, DeviceReadings::open(profile));
  return control;
}

ManualControl::ManualControl(Profile profile, std::shared_ptr<Operator> person, access::Permit permit)
    : m_profile(std::move(profile)), m_person(std::move(person)), m_permit(permit) {}

Result<acquisition::MachineIdentity> ManualControl::identify() {
  acquisition::MachineIdentity identity;
  identity.name = m_profile.name;
  identity.serial = m_profile.serial;
  identity.accepts_table = true;
  identity.accepts_host_offset = true;
  identity.has_probes = !m_profile.sources.probes.empty();
  for (const auto& sensor : m_profile.sensors) {
    identity.sensors.push_back({sensor.channel, sensor.label, sensor.place, sensor.accuracy_C});
  }
  if (m_devices) m_devices->wait_for_first();
  return identity;
}

Result<acquisition::MachineSample> ManualControl::read() {
  ZD_CHECK(know_state());
  constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
  acquisition::MachineSample sample;
  sample.machine_time_s = host_clock().steady().count() * m_profile.time_factor;
  sample.axes = m_position_mm;
  const Command now = m_done.value_or(Command{});
  sample.spindle_rpm = m_done ? now.spindle_rpm : nothing;
  sample.spindle_load_W = nothing;
  sample.coolant_on = now.coolant_on;
  sample.cycling = now.path_cycle;
  sample.compensation_on = *m_compensation_on;
  sample.ambient_C = nothing;
  sample.temperature_C.assign(m_profile.sensors.size(), nothing);
  sample.applied_um.fill(nothing);
  if (m_devices) m_devices->put_into(sample);
  return sample;
}

Status ManualControl::know_state() {
  if (m_compensation_on) return {};
  OperatorRequest request;
  request.act = OperatorAct::state;
  ZD_TRY(const OperatorAnswer answer, m_person->ask(request));
  if (!answer.compensation_on) {
    return fail(ErrorCode::operator_declined,
                {{"request", std::string(name_of(request.act))}, {"reason", "the switch's state was not said"}});
  }
  m_compensation_on = answer.compensation_on;
  return {};
}

Status ManualControl::command(double spindle_rpm, bool coolant_on, bool path_cycle) {
  m_wanted = {spindle_rpm, coolant_on, path_cycle};
  if (m_done == m_wanted) return {};
  Command path_stops = m_wanted;
  path_stops.path_cycle = true;
  if (m_done == path_stops) return {};  // with the move that comes
  OperatorRequest request;
  request.act = OperatorAct::command;
  request.spindle_rpm = spindle_rpm;
  request.coolant_on = coolant_on;
  request.path_cycle = path_cycle;
  ZD_CHECK(m_person->ask(request).map([](const auto&) {}));
  m_done = m_wanted;
  m_elsewhere = m_elsewhere || path_cycle;
  return {};
}

Status ManualControl::move_to(const std::map<std::string, double>& target_mm) {
  if (!m_elsewhere && m_done == m_wanted && m_position_mm == target_mm) return {};
  OperatorRequest request;
  request.act = OperatorAct::move;
  request.spindle_rpm = m_wanted.spindle_rpm;
  request.coolant_on = m_wanted.coolant_on;
  request.target_mm = target_mm;
  ZD_CHECK(m_person->ask(request).map([](const auto&) {}));
  for (const auto& [axis, position_mm] : target_mm) m_position_mm[axis] = position_mm;
  m_wanted.path_cycle = false;
  if (m_done) m_done->path_cycle = false;
  m_elsewhere = false;
  return {};
}

Status ManualControl::switch_compensation(bool on) {
  ZD_CHECK(m_permit.check(on ? "Switching the compensation on" : "Switching the compensation off"));
  ZD_CHECK(know_state());
  if (*m_compensation_on == on) return {};
  OperatorRequest request;
  request.act = OperatorAct::switch_compensation;
  request.compensation_on = on;
  ZD_CHECK(m_person->ask(request).map([](const auto&) {}));
  m_compensation_on = on;
  m_changed = host_clock().steady();
  return {};
}

Result<bool> ManualControl::compensation_on() {
  ZD_TRY(const auto sample, read());
  return sample.compensation_on;
}

Result<double> ManualControl::wait_for_ramp(bool on, const std::stop_token& stop) {
  const double ramp_s = m_profile.max_um / m_profile.max_um_per_s / m_profile.time_factor;
  if (m_changed.count() > 0.0 && !host_clock().wait_until(m_changed + Seconds(ramp_s), stop)) {
    return fail(ErrorCode::cancelled);
  }
  return on ? 100.0 : 0.0;
}

Status ManualControl::write_host_offset(const std::array<double, 3>& compensation_um) {
  ZD_CHECK(m_permit.check("A test offset"));
  if (compensation_um == m_offset_um) return {};
  ZD_TRY(const bool on, compensation_on());
  ZD_CHECK(compensation::allow_offset_write(on));
  for (const double um : compensation_um) {
    if (std::isfinite(um) && std::abs(um) <= m_profile.max_um) continue;
    return fail(ErrorCode::limit_exceeded, {{"what", "a test offset"},
                                            {"found", fmt::format("{:.2f} um", um)},
                                            {"limit", fmt::format("{:.0f} um", m_profile.max_um)}});
  }
  OperatorRequest request;
  request.act = OperatorAct::offset;
  request.offset_um = compensation_um;
  ZD_CHECK(m_person->ask(request).map([](const auto&) {}));
  m_offset_um = compensation_um;
  m_changed = host_clock().steady();
  return {};
}

std::vector<std::string> ManualControl::remarks() const {
  return m_devices ? m_devices->remarks() : std::vector<std::string>();
}

Status ManualControl::load_table(const std::string& file, const std::string& check) {
  ZD_CHECK(m_permit.check("Writing the table"));
  OperatorRequest request;
  request.act = OperatorAct::load_table;
  request.file = file;
  ZD_TRY(const OperatorAnswer answer, m_person->ask(request));
  m_changed = host_clock().steady();
  if (answer.check == check) return {};
  return fail(ErrorCode::upload_read_back,
              {{"register", "the control's check value"}, {"written", check}, {"read", answer.check}});
}

Result<std::string> ManualControl::table_check() {
  OperatorRequest request;
  request.act = OperatorAct::check_table;
  ZD_TRY(const OperatorAnswer answer, m_person->ask(request));
  return answer.check;
}

}  // namespace zerodrift::controller
