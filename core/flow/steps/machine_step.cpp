#include "core/flow/steps/machine_step.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace zerodrift::flow {

using nlohmann::json;

namespace {

json sensors_json(const acquisition::MachineHealth& health) {
  json list = json::array();
  for (const auto& sensor : health.sensors) {
    json row = {{"channel", sensor.info.channel},
                {"label", sensor.info.label},
                {"place", sensor.info.place},
                {"state", acquisition::name_of(sensor.state)},
                {"value_C", nullptr},
                {"noise_K", nullptr}};
    if (sensor.value_C) row["value_C"] = *sensor.value_C;
    if (sensor.noise_C) row["noise_K"] = *sensor.noise_C;
    list.push_back(std::move(row));
  }
  return list;
}

}  // namespace

Result<commissioning::NewArtefact> check_machine(Devices& devices, const json& profile, const TaskContext& context,
                                                 acquisition::MachineHealth* health) {
  SystemClock clock(devices.profile.time_factor);
  acquisition::HealthOptions options;
  options.time_factor = devices.profile.time_factor;
  options.interval_s = 0.1;
  ZD_TRY(const auto found, acquisition::machine_health(*devices.machine, clock, options, context));
  json problems = json::array();
  for (const auto& sensor : found.sensors) {
    if (sensor.state == acquisition::SensorState::ok) continue;
    problems.push_back("sensor " + sensor.info.channel + " (" + sensor.info.label + ") is " +
                       std::string(acquisition::name_of(sensor.state)));
  }
  for (const auto& remark : devices.machine->remarks()) problems.push_back(remark);
  for (const auto& [device, fault] : found.last.device_faults) {
    problems.push_back(fmt::format("device {} does not answer: {}", device, describe(fault)));
  }
  ZD_TRY(const json kept, controller::document_for_job(profile, devices.profile));
  const json body = {{"profile", kept},
                     {"identity",
                      {{"name", found.identity.name},
                       {"serial", found.identity.serial},
                       {"map_version", found.identity.map_version},
                       {"accepts_table", found.identity.accepts_table},
                       {"accepts_host_offset", found.identity.accepts_host_offset},
                       {"has_probes", found.identity.has_probes}}},
                     {"health", sensors_json(found)},
                     {"sensors_alive", found.sensors_alive},
                     {"spread_K", found.spread_K},
                     {"round_trip_ms", found.round_trip_ms},
                     {"clock_difference_s", found.clock_difference_s},
                     {"compensation_on", found.last.compensation_on},
                     {"problems", problems}};
  if (health != nullptr) *health = found;
  auto made = commissioning::NewArtefact::of("machine", body);
  // What a look shows anew each time makes no later step stale: the machine is still the same one.
  made.observed = {"health",          "sensors_alive", "spread_K", "round_trip_ms", "clock_difference_s",
                   "compensation_on", "problems"};
  return made;
}

}  // namespace zerodrift::flow
