#include "core/controller/profile.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/base/redact.h"
#include "core/controller/profile_devices.h"
#include "core/controller/register_map.h"

namespace zerodrift::controller {
namespace {

constexpr NumberRange factor_range{0.0, 100000.0, true, "a number above 0, at most 100000"};

constexpr NumberRange exposure_range{1.0, 1e7, false, "a time from 1 to 10000000 us"};
constexpr NumberRange gain_range{-100.0, 100.0, false, "a gain from -100 to 100 dB"};
constexpr NumberRange latency_range{0.1, 60.0, false, "a time from 0.1 to 60 s"};

std::array<int, 4> region_of(const JsonObject& o, const std::string& key, const std::vector<double>& numbers) {
  std::array<int, 4> region{};
  for (std::size_t i = 0; i < 4; ++i) {
    if (numbers[i] < 0 || numbers[i] > 100000 || (i > 1 && numbers[i] < 1)) {
      o.reject(key, fmt::format("{}", numbers[i]), "x, y, width and height in pixels");
    }
    region[i] = static_cast<int>(numbers[i]);
  }
  return region;
}

/// Fixed marks: one region, or a list of regions.
std::vector<std::array<int, 4>> read_marks(JsonObject& o, const char* key) {
  const nlohmann::json* marks = o.raw(key);
  if (marks == nullptr) return {};
  if (!marks->is_array() || marks->empty() || !marks->front().is_array()) {
    return {region_of(o, key, o.numbers(key, 4))};
  }
  std::vector<std::array<int, 4>> regions;
  for (std::size_t k = 0; k < marks->size(); ++k) {
    const nlohmann::json& mark = (*marks)[k];
    const std::string name = fmt::format("{}[{}]", key, k);
    std::vector<double> numbers;
    const bool list = mark.is_array() && mark.size() == 4;
    for (std::size_t i = 0; list && i < 4; ++i) {
      if (mark[i].is_number()) numbers.push_back(mark[i].get<double>());
    }
    if (numbers.size() != 4) o.reject(name, json_text(mark).substr(0, 60), "x, y, width and height in pixels");
    regions.push_back(region_of(o, name, numbers));
  }
  return regions;
}

CameraProfile read_camera(JsonObject& o) {
  CameraProfile camera;
  camera.id = filled(o, "id");
  camera.url = filled(o, "url", "an address of the camera");
  const auto axes = o.texts_or_empty("axes");
  if (axes.size() != 2) o.reject("axes", fmt::format("{} axes", axes.size()), "two axes, right and up in the image");
  camera.axes = {axes[0], axes[1]};
  camera.um_per_px_nominal = o.number_or("um_per_px_nominal", 0.0, not_negative);
  camera.target_roi_px = region_of(o, "target_roi_px", o.numbers("target_roi_px", 4));
  camera.reference_rois_px = read_marks(o, "reference_roi_px");
  camera.pixel_size_known = o.flag_or("pixel_size_known", true);
  camera.assumed_latency_s = o.number_or("assumed_latency_s", camera.assumed_latency_s, latency_range);
  camera.exposure_us = o.number_if("exposure_us", exposure_range);
  camera.gain_db = o.number_if("gain_db", gain_range);
  for (const char* key : {"exposure_us", "gain_db"}) {
    if (o.number_if(key) && camera.url.find("://") != std::string::npos) {
      o.reject(key, "a stream over the network", "a camera at aravis: or a device; a stream is set in its camera");
    }
  }
  return camera;
}

SensorProfile read_sensor(JsonObject& o) {
  SensorProfile sensor;
  sensor.channel = filled(o, "channel");
  sensor.label = o.text_or("label", sensor.channel);
  sensor.place = o.text_or("place", "");
  sensor.position_mm = o.number_if("position_mm");
  sensor.accuracy_C = o.number_or("accuracy_C", 0.1, positive);
  sensor.source = read_source(o);
  return sensor;
}

Profile read_body(JsonObject& o) {
  Profile profile;
  o.word("format", {"zerodrift-profile/1"});
  profile.name = o.text_or("name", "");
  profile.time_factor = o.number_or("time_factor", 1.0, factor_range);
  read_devices(o, profile);
  for (JsonObject& camera : o.objects_or_empty("cameras")) profile.cameras.push_back(read_camera(camera));
  if (JsonObject* errors = o.object_if("errors"); errors != nullptr) {
    const bool probes = errors->word("source", {"camera", "probes"}) == "probes";
    profile.error_source = probes ? ErrorSourceKind::probes : ErrorSourceKind::camera;
  }
  if (JsonObject* position = o.object_if("measure_position_mm"); position != nullptr) {
    for (const auto& axis : position->keys()) profile.measure_position_mm[axis] = position->number(axis);
  }
  profile.calibration_span_mm = o.number_or("calibration_span_mm", 1.6, positive);
  for (JsonObject& sensor : o.objects_or_empty("sensors")) profile.sensors.push_back(read_sensor(sensor));
  read_signals(o, profile);
  if (JsonObject* limits = o.object_if("limits"); limits != nullptr) {
    profile.max_um = limits->number_or("max_um", profile.max_um, positive);
    profile.max_um_per_s = limits->number_or("max_um_per_s", profile.max_um_per_s, positive);
    profile.max_drift_um_per_min = limits->number_or("max_drift_um_per_min", profile.max_drift_um_per_min, positive);
    profile.max_um_per_K = limits->number_or("max_um_per_K", profile.max_um_per_K, positive);
  }
  o.raw("machine");
  return profile;
}

/// A stream over the network or a device; whatever else the video library understands would be a file.
bool leads_to_a_camera(const std::string& url) {
  const bool number = !url.empty() && url.find_first_not_of("0123456789") == std::string::npos;
  if (number || (url.rfind("/dev/video", 0) == 0 && url.find("..") == std::string::npos)) return true;
  for (const char* scheme : {"http://", "https://", "rtsp://", "aravis:"}) {
    if (url.rfind(scheme, 0) == 0) return true;
  }
  return false;
}

}  // namespace

Result<Profile> profile_from_json(const nlohmann::json& document, const std::string& file,
                                  std::vector<std::string>* warnings) {
  ZD_TRY(Profile profile, from_json<Profile>(document, file, warnings, read_body));
  profile.file = file;
  for (DeviceProfile& device : profile.devices) device.file = file;
  const auto machine = document.find("machine");
  if (machine == document.end() || machine->is_null()) return profile;
  if (machine->is_string()) {
    const auto path = std::filesystem::path(file).parent_path() / machine->get<std::string>();
    ZD_TRY(nlohmann::json description, read_json_file(path));
    profile.machine = std::make_shared<const nlohmann::json>(std::move(description));
    profile.machine_file = path.string();
  } else {
    profile.machine = std::make_shared<const nlohmann::json>(*machine);
    profile.machine_file = file;
  }
  return profile;
}

Result<nlohmann::json> document_for_job(const nlohmann::json& document, const Profile& profile) {
  nlohmann::json kept = document_without_secrets(document);
  if (const auto machine = kept.find("machine"); machine != kept.end() && machine->is_string() && profile.machine) {
    *machine = *profile.machine;
  }
  const auto folder = std::filesystem::path(profile.file).parent_path();
  const auto with_map = [&](nlohmann::json& settings) -> Status {
    if (!settings.is_object() || settings.contains("register_map_document")) return {};
    const std::string name = settings.value("register_map", "");
    const auto path = register_map_file(name, folder);
    if (path.empty()) return {};
    ZD_TRY(settings["register_map_document"], read_json_file(path));
    settings["register_map"] = std::filesystem::path(name).stem().string();
    return {};
  };
  if (const auto controller = kept.find("controller"); controller != kept.end()) ZD_CHECK(with_map(*controller));
  if (const auto devices = kept.find("devices"); devices != kept.end() && devices->is_array()) {
    for (nlohmann::json& device : *devices) ZD_CHECK(with_map(device));
  }
  return kept;
}

Result<Profile> profile_from_job(const nlohmann::json& document) {
  if (!document.is_object()) return profile_from_json(document, "the job's profile");
  const auto refused = [](const char* key, const std::string& found) {
    return fail(ErrorCode::job_reaches_out, {{"key", key}, {"found", found}});
  };
  if (const auto machine = document.find("machine"); machine != document.end() && machine->is_string()) {
    return refused("machine", machine->get<std::string>());
  }
  ZD_TRY(Profile profile, profile_from_json(document, "the job's profile"));
  const auto reaches_out = [](const ControllerSettings& settings) {
    return !settings.own_map && settings.register_map.find_first_of("/\\.") != std::string::npos;
  };
  if (reaches_out(profile.controller)) return refused("controller.register_map", profile.controller.register_map);
  for (DeviceProfile& device : profile.devices) {
    if (reaches_out(device.modbus)) return refused("devices.register_map", device.modbus.register_map);
    for (const std::string& path : {device.ca_file, device.credentials_file}) {
      if (!path.empty()) return refused("devices.credentials_file", path);
    }
    device.of_job = true;
  }
  for (const auto& camera : profile.cameras) {
    if (!leads_to_a_camera(camera.url)) return refused("cameras.url", without_secrets(camera.url));
  }
  profile.of_job = true;
  return profile;
}

Result<Profile> read_profile(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const nlohmann::json document, read_json_file(path));
  return profile_from_json(document, path.string(), warnings);
}

Result<int> sensor_number(const Profile& profile, const std::string& channel) {
  if (channel == "ambient_C") return 0;
  std::string available = "ambient_C";
  for (std::size_t i = 0; i < profile.sensors.size(); ++i) {
    if (profile.sensors[i].channel == channel) return static_cast<int>(i) + 1;
    available += ", " + profile.sensors[i].channel;
  }
  return fail(ErrorCode::channel_missing, {{"channel", channel}, {"available", available}});
}

Result<std::string> sensor_channel(const Profile& profile, int number) {
  if (number == 0) return "ambient_C";
  if (number < 0 || number > static_cast<int>(profile.sensors.size())) {
    return fail(ErrorCode::data_does_not_fit, {{"what", "a sensor number of the controller's table"},
                                               {"found", std::to_string(number)},
                                               {"expected", fmt::format("0 to {}", profile.sensors.size())}});
  }
  return profile.sensors[number - 1].channel;
}

}  // namespace zerodrift::controller
