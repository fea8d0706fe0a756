#include "core/controller/live_signals.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/controller/devices/device.h"
#include "core/controller/devices/mtconnect_device.h"
#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {
namespace {

constexpr const char* control_id = "/control";  // among the devices of the profile
constexpr std::size_t most_tested = 32;         // values of one device that a test shows
constexpr Seconds first_value_patience{3.0};    // of a broker's sensors, which come when they come
constexpr Seconds look_pause{0.1};

/// The control as one of the devices; nothing when a person is its link.
std::optional<DeviceProfile> control_of(const Profile& profile) {
  if (profile.manual) return std::nullopt;
  DeviceProfile control;
  control.id = control_id;
  control.modbus = profile.controller;
  control.file = profile.file;
  control.of_job = profile.of_job;
  control.timeout_ms = profile.controller.timeout_ms;
  return control;
}

}  // namespace

Result<std::shared_ptr<LiveSignals>> LiveSignals::open(const Profile& profile, const std::vector<SignalRow>& rows) {
  // Every row is read as if it were a sensor: the values come back in the order of the rows.
  Profile all;
  all.file = profile.file;
  all.of_job = profile.of_job;
  all.devices = profile.devices;
  const auto control = control_of(profile);
  if (control) all.devices.push_back(*control);
  auto out = std::shared_ptr<LiveSignals>(new LiveSignals);
  for (const SignalRow& row : rows) {
    SensorProfile sensor;
    sensor.source = row.source;
    if (row.source.device.empty()) {
      if (!control) continue;
      sensor.source = {control_id, control_signal(row)};
      if (!open_device(*control, {sensor.source.signal})) continue;  // a map need not have it
    }
    out->m_rows.emplace_back(row.place, sensor.source.device);
    all.sensors.push_back(std::move(sensor));
  }
  ZD_TRY(out->m_readings, DeviceReadings::open(all));
  return out;
}

std::map<std::string, LiveValue> LiveSignals::values() const {
  std::map<std::string, LiveValue> values;
  if (!m_readings) return values;
  acquisition::MachineSample sample;
  m_readings->put_into(sample);
  const auto states = m_readings->states();
  for (std::size_t i = 0; i < m_rows.size(); ++i) {
    const auto asked = std::find_if(states.begin(), states.end(),
                                    [&](const DeviceState& state) { return state.id == m_rows[i].second; });
    if (asked != states.end() && asked->rounds + asked->faults > 0) {
      values[m_rows[i].first] = {sample.temperature_C[i], asked->rounds};
    }
  }
  return values;
}

std::vector<DeviceState> LiveSignals::states() const {
  return m_readings ? m_readings->states() : std::vector<DeviceState>();
}

Result<DeviceTest> test_device(const DeviceProfile& device, std::vector<std::string> signals,
                               const std::stop_token& stop) {
  if (device.kind == DeviceKind::modbus) {
    Profile alone;
    alone.file = device.file;
    alone.of_job = device.of_job;
    alone.controller = device.modbus;
    ZD_TRY(const RegisterMap map, map_of(alone));
    signals.clear();
    for (const auto& [name, entry] : map.registers) {
      const bool area = entry.count > static_cast<int>(most_tested);  // a table
      for (int i = 1; !area && i <= entry.count && signals.size() < most_tested; ++i) {
        signals.push_back(entry.count == 1 ? name : fmt::format("{}[{}]", name, i));
      }
    }
  }
  if (device.kind == DeviceKind::mtconnect) {
    ZD_TRY(signals, agent_samples(device));
  }
  ZD_TRY(const auto opened, open_device(device, signals));
  DeviceTest test;
  const Seconds end = host_clock().steady() + first_value_patience;
  for (;;) {
    const Seconds begun = host_clock().steady();
    ZD_TRY(const std::vector<Reading> readings, opened->read());
    const Seconds now = host_clock().steady();
    if (test.round_trip_s == 0.0) test.round_trip_s = (now - begun).count();
    test.values.clear();
    for (std::size_t i = 0; i < readings.size(); ++i) test.values.emplace_back(signals[i], readings[i].value);
    const bool some =
        std::any_of(readings.begin(), readings.end(), [](const Reading& r) { return std::isfinite(r.value); });
    if (some || readings.empty() || device.kind != DeviceKind::mqtt || now > end) break;
    if (!host_clock().wait_for(look_pause, stop)) return fail(ErrorCode::cancelled);
  }
  test.remarks = opened->remarks();
  return test;
}

}  // namespace zerodrift::controller
