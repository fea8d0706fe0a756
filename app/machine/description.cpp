#include "app/machine/description.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "app/machine/camera/view.h"
#include "app/machine/nominal.h"
#include "app/machine/sensors.h"

namespace zerodrift::machine {
namespace {

using nlohmann::json;

json bearing_json(const char* id, const nominal::Bearing& bearing) {
  return {{"id", id},
          {"kind", "bearing"},
          {"from_mm", bearing.from_mm},
          {"to_mm", bearing.to_mm},
          {"mean_diameter_mm", bearing.mean_diameter_mm},
          {"f0", bearing.f0},
          {"f1", bearing.f1},
          {"load_N", bearing.load_N},
          {"oil_viscosity_mm2_s", bearing.viscosity_mm2_s}};
}

json spindle_json() {
  const json motor = {{"id", "motor"},
                      {"kind", "motor"},
                      {"from_mm", nominal::motor_from_mm},
                      {"to_mm", nominal::motor_to_mm},
                      {"rated_power_W", nominal::motor_rated_power_W},
                      {"efficiency", nominal::motor_net_efficiency},
                      {"rated_speed_rpm", nominal::top_speed_rpm}};
  return {{"id", "spindle"},
          {"length_mm", nominal::spindle_length_mm},
          {"outer_diameter_mm", nominal::housing_diameter_mm},
          {"bore_diameter_mm", nominal::bore_diameter_mm},
          {"material",
           {{"conductivity_W_mK", nominal::conductivity_W_mK},
            {"density_kg_m3", nominal::density_kg_m3},
            {"heat_capacity_J_kgK", nominal::heat_capacity_J_kgK},
            {"expansion_1_K", nominal::expansion_1_K}}},
          {"heat_sources",
           {motor, bearing_json("rear_bearing", nominal::rear_bearing),
            bearing_json("front_bearing", nominal::front_bearing)}}};
}

json sensors_json() {
  json sensors = json::array();
  for (int i = 0; i < sensor_count; ++i) {
    const SensorPlace& place = sensor_places()[i];
    if (place.place != "spindle") continue;
    sensors.push_back({{"channel", fmt::format("T{}_C", i + 1)},
                       {"component", "spindle"},
                       {"position_mm", place.position_mm},
                       {"accuracy_C", 0.1}});
  }
  sensors.push_back({{"channel", "ambient_C"}, {"component", "ambient"}});
  return sensors;
}

/// A box of 160 px about where the spindle's target stands, and one about each of the table's marks.
json camera_json(View view, const Endpoints& endpoints) {
  const ViewOptions options = view_options(view, 1);
  constexpr int target_px = 160;
  constexpr int mark_px = 120;
  json marks = json::array();
  for (const PixelPosition& mark : options.reference_marks_px) {
    marks.push_back(
        {static_cast<int>(mark.x_px) - mark_px / 2, static_cast<int>(mark.y_px) - mark_px / 2, mark_px, mark_px});
  }
  return {{"id", name_of(view)},
          {"url", fmt::format("http://{}:{}/{}.mjpg", endpoints.host, endpoints.camera_port, name_of(view))},
          {"axes", {view == View::front ? "X" : "Y", "Z"}},
          {"um_per_px_nominal", 12.0},
          {"target_roi_px",
           {(options.width_px - target_px) / 2, (options.height_px - target_px) / 2, target_px, target_px}},
          {"reference_roi_px", std::move(marks)},
          {"pixel_size_known", false}};
}

/// The modules have sensors 1 to 16, eight each; the agent, or the broker, the last four.
constexpr int module_channels = 8;
constexpr int first_beside_modules = 17;
constexpr int first_at_broker = 19;

struct Source {
  std::string device;
  std::string signal;
};

Source source_of_sensor(int sensor, const RigEndpoints& rig) {
  if (sensor < first_beside_modules) {
    return {fmt::format("module-{}", (sensor - 1) / module_channels + 1),
            fmt::format("temperature_C[{}]", (sensor - 1) % module_channels + 1)};
  }
  if (sensor >= first_at_broker && !rig.broker_host.empty()) {
    return {"shop", fmt::format("shop/T{}#/temperature_C", sensor)};
  }
  return {"agent", fmt::format("T{}", sensor)};
}

json to_json(const Source& source) {
  return {{"device", source.device}, {"signal", source.signal}};
}

json module_json(int unit, const RigEndpoints& rig) {
  return {{"id", fmt::format("module-{}", unit)},
          {"kind", "modbus-rtu"},
          {"device", rig.serial_line},
          {"baud", 19200},
          {"parity", "N"},
          {"unit", unit},
          {"timeout_ms", 300},
          {"register_map", "temperature-module-8-pt100"}};
}

json devices_json(const RigEndpoints& rig, int speedup) {
  json devices = json::array(
      {module_json(1, rig),
       module_json(2, rig),
       {{"id", "amplifier"},
        {"kind", "modbus-tcp"},
        {"host", "127.0.0.1"},
        {"port", rig.amplifier_port},
        {"unit", 1},
        {"register_map", "probe-amplifier"}},
       {{"id", "agent"}, {"kind", "mtconnect"}, {"url", fmt::format("http://127.0.0.1:{}/", rig.agent_port)}}});
  if (!rig.broker_host.empty()) {
    devices.push_back({{"id", "shop"}, {"kind", "mqtt"}, {"host", rig.broker_host}, {"port", rig.broker_port}});
  }
  for (json& device : devices) {
    device["poll_period_s"] = std::clamp(1.0 / speedup, 0.02, 1.0);  // a machine second, but no flood of requests
    device["stale_after_s"] = 5;
  }
  return devices;
}

/// The profile of the whole machine at one Modbus server becomes that of the parts.
void split_into_parts(json& profile, const RigEndpoints& rig, int speedup) {
  profile["devices"] = devices_json(rig, speedup);
  int sensor = 0;
  for (json& one : profile["sensors"]) one.update(to_json(source_of_sensor(++sensor, rig)));
  profile["ambient"] =
      rig.broker_host.empty() ? to_json({"agent", "room"}) : to_json({"shop", "shop/room#/temperature_C"});
  profile["probes"] = to_json({"amplifier", "probe_um"});
  if (rig.operator_port == 0) {
    profile["controller"]["register_map"] = "virtual-rig-control";
    return;
  }
  profile.erase("controller");
  profile["devices"].push_back({{"id", "control"}, {"kind", "manual"}});
  profile["speed"] = to_json({"agent", "S1speed"});
}

}  // namespace

json machine_description(const HiddenEffects& hidden) {
  json description = {
      {"format", "zerodrift-machine/1"},
      {"name", "Virtual five-axis"},
      {"components", {spindle_json()}},
      {"effects", {"convection"}},
      {"effect_parameters", {{"convection", {{"h_W_m2K", nominal::film_W_m2K}}}}},
      {"tolerances", {{"conductivity", 0.05}, {"heat_capacity", 0.04}, {"heat_source_power", 0.15}, {"film", 0.15}}},
      {"sensors", sensors_json()},
      {"displacements",
       {{{"channel", "dZ_um"}, {"direction", "Z"}, {"component", "spindle"}},
        {{"channel", "dY_um"}, {"direction", "Y"}, {"component", "spindle"}}}}};
  if (hidden.is("convection")) {
    description["effects"] = json::array();
    description.erase("effect_parameters");
  }
  return description;
}

/// The cameras see the tool against the table: headstock, column, bed and screws move it too and are not described. Of
/// Z they take 7 um (rms) over a warm-up, a sixth of what the spindle grows and in step with it; of Y it is nearly all
/// there is.
json description_for_cameras(const HiddenEffects& hidden) {
  json description = machine_description(hidden);
  for (json& displacement : description["displacements"]) {
    displacement["accuracy_um"] = displacement["direction"] == "Z" ? 7.0 : 10.0;
  }
  return description;
}

json connection_profile(const Endpoints& endpoints, const HiddenEffects& hidden) {
  json sensors = json::array();
  for (int i = 0; i < sensor_count; ++i) {
    const SensorPlace& place = sensor_places()[i];
    sensors.push_back({{"channel", fmt::format("T{}_C", i + 1)},
                       {"label", place.label},
                       {"place", place.place},
                       {"position_mm", place.position_mm},
                       {"accuracy_C", 0.1}});
  }
  json profile = {{"format", "zerodrift-profile/1"},
                  {"name", "Virtual five-axis"},
                  {"time_factor", endpoints.speedup},
                  {"controller",
                   {{"kind", "modbus-tcp"},
                    {"host", endpoints.host},
                    {"port", endpoints.port},
                    {"unit", 1},
                    {"timeout_ms", 1000},
                    {"register_map", "zerodrift-virtual"}}},
                  {"cameras", {camera_json(View::front, endpoints), camera_json(View::side, endpoints)}},
                  {"errors", {{"source", "camera"}}},
                  {"measure_position_mm", {{"X", 0}, {"Y", 0}, {"Z", 0}}},
                  {"calibration_span_mm", 1.6},
                  {"sensors", sensors},
                  {"limits", {{"max_um", 200}, {"max_um_per_s", 2}}},
                  {"machine", description_for_cameras(hidden)}};
  if (endpoints.serial != 0) profile["controller"]["serial"] = endpoints.serial;
  if (endpoints.rig) split_into_parts(profile, *endpoints.rig, endpoints.speedup);
  return profile;
}

}  // namespace zerodrift::machine
