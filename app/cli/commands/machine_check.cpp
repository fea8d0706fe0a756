// machine check: connects, and lists what there is - sensors, axes, cameras, switch - and how well it is.

#include <fmt/format.h>

#include <cmath>

#include "app/cli/command.h"
#include "app/cli/commands/machine_map.h"
#include "app/text/error_text.h"
#include "core/base/redact.h"
#include "core/controller/device_readings.h"
#include "core/controller/modbus_machine.h"
#include "core/flow/devices.h"
#include "core/vision/camera.h"

namespace zerodrift::cli {
namespace machine_check_command {

using nlohmann::json;

constexpr std::chrono::milliseconds camera_timeout{8000};

std::string sentence(const Error& error) {
  return lineOf(error).toStdString();
}

void list_sensors(const acquisition::MachineIdentity& identity, const acquisition::MachineSample& sample,
                  CommandOutput& output) {
  json sensors = json::array();
  output.text += fmt::format("ambient        {:.2f} C\n", sample.ambient_C);
  for (std::size_t i = 0; i < identity.sensors.size(); ++i) {
    const auto& sensor = identity.sensors[i];
    const double value = sample.temperature_C[i];
    const bool alive = std::isfinite(value);
    json row = {{"channel", sensor.channel}, {"label", sensor.label}, {"ok", alive}};
    row["temperature_C"] = alive ? json(value) : json(nullptr);
    sensors.push_back(row);
    output.text += fmt::format("{:<8} {:>8} C  {}\n", sensor.channel, alive ? fmt::format("{:.2f}", value) : "no value",
                               sensor.label);
    if (!alive) output.warnings.push_back(sentence(Error{ErrorCode::sensor_dead, {{"sensor", sensor.channel}}}));
  }
  output.json["sensors"] = sensors;
  output.json["ambient_C"] = std::isfinite(sample.ambient_C) ? json(sample.ambient_C) : json(nullptr);
}

void list_state(const acquisition::MachineIdentity& identity, const acquisition::MachineSample& sample,
                CommandOutput& output) {
  output.json["name"] = identity.name;
  output.json["serial"] = identity.serial;
  output.json["map_version"] = identity.map_version;
  output.json["accepts_table"] = identity.accepts_table;
  output.json["accepts_host_offset"] = identity.accepts_host_offset;
  output.json["has_probes"] = identity.has_probes;
  output.json["compensation_on"] = sample.compensation_on;
  output.json["referenced"] = sample.referenced;
  output.json["moving"] = sample.moving;
  output.json["alarm"] = sample.alarm;
  output.json["spindle_rpm"] = sample.spindle_rpm;
  output.json["coolant_on"] = sample.coolant_on;
  output.json["axes"] = sample.axes;
  output.text += fmt::format("{}, serial number {}\n", identity.name, identity.serial);
  for (const auto& [axis, position] : sample.axes) {
    output.text += fmt::format("{} {:.3f} {}  ", axis, position, axis < "D" ? "deg" : "mm");
  }
  output.text += fmt::format("\ncompensation {}, {}{}{}\n", sample.compensation_on ? "ON" : "OFF",
                             sample.referenced ? "referenced" : "NOT referenced", sample.moving ? ", moving" : "",
                             sample.alarm ? ", ALARM" : "");
  output.text += fmt::format("table {}, host offset {}, probes {}\n", identity.accepts_table ? "yes" : "no",
                             identity.accepts_host_offset ? "yes" : "no", identity.has_probes ? "yes" : "no");
}

/// A camera that is the source of errors must work; one beside probes is only warned of.
Status look_at_cameras(const controller::Profile& profile, const TaskContext& context, CommandOutput& output) {
  json cameras = json::array();
  for (const auto& entry : profile.cameras) {
    const auto opened = flow::open_camera(entry);
    const vision::Camera& camera = *opened;
    const auto frame = camera.fresh_frame(vision::Camera::Time::clock::now(), camera_timeout, context.stop);
    json row = {{"id", entry.id}, {"url", without_secrets(entry.url)}, {"ok", frame.has_value()}};
    if (frame) {
      row["width_px"] = (*frame)->image.width;
      row["height_px"] = (*frame)->image.height;
      const auto identity = camera.identity().value_or(vision::CameraIdentity{});
      if (!identity.serial.empty()) row["serial"] = identity.serial;
      if (!identity.model.empty()) row["model"] = identity.model;
      if (identity.exposure_us) row["exposure_us"] = *identity.exposure_us;
      const auto health = camera.health();
      row["pictures_incomplete"] = health.incomplete;
      row["pictures_lost"] = health.lost;
      output.text += fmt::format("camera {:<8} {} x {} px{}\n", entry.id, (*frame)->image.width, (*frame)->image.height,
                                 identity.serial.empty() ? "" : ", serial " + identity.serial);
      if (health.incomplete + health.lost > 0) {
        output.warnings.push_back(
            fmt::format("camera {}: {} pictures incomplete, {} lost", entry.id, health.incomplete, health.lost));
      }
    } else {
      if (profile.error_source == controller::ErrorSourceKind::camera) return fail(frame.error());
      output.warnings.push_back(sentence(frame.error()));
    }
    cameras.push_back(row);
  }
  output.json["cameras"] = cameras;
  return {};
}

void list_devices(const controller::DeviceReadings& readings, CommandOutput& output) {
  json devices = json::array();
  for (const auto& state : readings.states()) {
    json row = {{"id", state.id},
                {"ok", !state.fault},
                {"rounds", state.rounds},
                {"faults", state.faults},
                {"round_trip_ms", 1000.0 * state.round_trip_s},
                {"remarks", state.remarks}};
    row["age_s"] = state.age_s ? json(*state.age_s) : json(nullptr);
    devices.push_back(row);
    output.text += fmt::format("device {:<12} {}\n", state.id,
                               state.fault ? "no answer" : fmt::format("{:.0f} ms", 1000.0 * state.round_trip_s));
    if (state.fault) {
      output.warnings.push_back(
          sentence(Error{ErrorCode::device_failing, {{"device", state.id}, {"reason", sentence(*state.fault)}}}));
    }
  }
  output.json["devices"] = devices;
}

void list_link(const controller::LinkHealth& health, CommandOutput& output) {
  output.json["link"] = {{"requests", health.requests}, {"retries", health.retries}, {"faults", health.faults}};
  for (const auto& [fault, count] : health.faults) {
    output.warnings.push_back(fmt::format("the link had {} x {}; the requests were repeated", count, fault));
  }
  output.json["link"]["remarks"] = health.remarks;
  output.warnings.insert(output.warnings.end(), health.remarks.begin(), health.remarks.end());
}

/// A control without a link is asked by nobody here; the devices beside it are.
Status look_at_manual(const controller::Profile& profile, CommandOutput& output) {
  ZD_TRY(const auto readings, controller::DeviceReadings::open(profile));
  acquisition::MachineSample sample;
  acquisition::MachineIdentity identity;
  for (const auto& sensor : profile.sensors) {
    identity.sensors.push_back({sensor.channel, sensor.label, sensor.place, sensor.accuracy_C});
  }
  sample.ambient_C = std::nan("");
  readings->wait_for_first();
  readings->put_into(sample);
  output.json["name"] = profile.name;
  output.json["control"] = "manual";
  output.text += profile.name + ", manual control\n";
  list_sensors(identity, sample, output);
  list_devices(*readings, output);
  return {};
}

Status look_at_linked(const controller::Profile& profile, CommandOutput& output) {
  ZD_TRY(const auto machine, controller::ModbusMachine::open(profile));
  ZD_TRY(const auto identity, machine->identify());
  ZD_TRY(const auto sample, machine->read());
  list_state(identity, sample, output);
  list_sensors(identity, sample, output);
  if (machine->devices() != nullptr) list_devices(*machine->devices(), output);
  list_link(machine->health(), output);
  return {};
}

Result<CommandOutput> run(const std::string& file, const TaskContext& context) {
  CommandOutput output;
  ZD_TRY(const controller::Profile profile, controller::read_profile(file, &output.warnings));
  ZD_CHECK(profile.manual ? look_at_manual(profile, output) : look_at_linked(profile, output));
  ZD_CHECK(look_at_cameras(profile, context, output));
  if (!output.text.empty()) output.text.pop_back();
  return output;
}

}  // namespace machine_check_command

void add_machine_check(Cli& cli) {
  using namespace machine_check_command;
  struct Chosen {
    std::string profile;
    MapOptions map;
    CLI::App* make = nullptr;
    CLI::App* list = nullptr;
  };
  auto chosen = std::make_shared<Chosen>();
  CLI::App* machine = cli.add("machine", "Look at the connected machine", [chosen](const TaskContext& context) {
    if (chosen->make->parsed()) return make_map(chosen->map);
    if (chosen->list->parsed()) return list_registers(chosen->map);
    return run(chosen->profile, context);
  });
  const auto with_json = [&](CLI::App* command) {
    command->add_flag("--json", cli.json_output, "Print the result as JSON on stdout");
    return command;
  };
  CLI::App* check =
      with_json(machine->add_subcommand("check", "Connect and list sensors, axes, cameras and the switch"));
  check->add_option("--profile", chosen->profile, "Connection profile")->required();
  chosen->list = with_json(machine->add_subcommand("registers", "List every register with its decoded value"));
  chosen->list->add_option("--profile", chosen->map.profile, "Connection profile")->required();
  chosen->list->add_option("--map", chosen->map.list, "Another map than the profile's: JSON, or a CSV list");
  chosen->make = with_json(machine->add_subcommand("map", "Make a register map from a list of registers"));
  chosen->make
      ->add_option("--list", chosen->map.list, "CSV with name, address and, as needed, function, type, count, ...")
      ->required();
  for (CLI::App* command : {chosen->make, chosen->list}) {
    command->add_option("--base", chosen->map.base, "What a list with plain addresses calls the first register")
        ->check(CLI::IsMember({0, 1}));
  }
  chosen->make->add_option("--name", chosen->map.name, "Name of the map; default: of the file");
  chosen->make->add_option("--out", chosen->map.out, "Register map to write")->required();
  machine->require_subcommand(1);
}

}  // namespace zerodrift::cli
