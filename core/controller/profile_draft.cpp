#include "core/controller/profile_draft.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <set>

#include "core/base/json.h"
#include "core/base/json_path.h"
#include "core/controller/devices/device.h"
#include "core/controller/modbus_machine.h"
#include "core/controller/profile_devices.h"
#include "core/controller/profile_signals.h"

namespace zerodrift::controller {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr const char* new_profile = R"({"format": "zerodrift-profile/1", "name": "", "controller": {"kind": "manual"},
  "devices": [], "cameras": [], "errors": {"source": "camera"}, "calibration_span_mm": 1.6, "sensors": []})";
constexpr std::array<int, 4> new_region_px = {240, 160, 160, 160};

std::string text_at(const json& object, const char* key) {
  const auto at = object.is_object() ? object.find(key) : object.end();
  return at != object.end() && at->is_string() ? at->get<std::string>() : std::string();
}

json& list_at(json& document, const char* key) {
  json& list = document[key];
  if (!list.is_array()) list = json::array();
  return list;
}

template <class Taken>
std::string free_name(const std::string& base, const std::string& end, int first, const Taken& taken) {
  std::string name = base + end;
  for (int n = first; taken(name); ++n) name = base + std::to_string(n) + end;
  return name;
}

bool has(const json& list, const char* key, const std::string& value) {
  return std::any_of(list.begin(), list.end(), [&](const json& one) { return text_at(one, key) == value; });
}

/// A number with a point or a comma, whole where it is whole; else the text, for the reader to refuse.
json number_or_text(const std::string& text) {
  std::string point = text;
  std::replace(point.begin(), point.end(), ',', '.');
  const char* end = point.data() + point.size();
  int whole = 0;
  if (const auto [stop, error] = std::from_chars(point.data(), end, whole); error == std::errc() && stop == end)
    return whole;
  double number = 0.0;
  if (const auto [stop, error] = std::from_chars(point.data(), end, number); error == std::errc() && stop == end)
    return number;
  return text;
}

json list_of(const std::string& text, bool numbers) {
  json list = json::array();
  std::string word;
  for (const char c : text + " ") {
    const bool between = c == ' ' || c == ',' || c == ';';
    if (!between) word += c;
    if (!between || word.empty()) continue;
    list.push_back(numbers ? number_or_text(word) : json(word));
    word.clear();
  }
  return list;
}

json value_of(const std::string& key, const std::string& text) {
  static const std::set<std::string> numbers = {
      "port",          "baud",       "stop_bits",   "unit",    "timeout_ms",         "poll_period_s",
      "stale_after_s", "serial",     "exposure_us", "gain_db", "um_per_px_nominal",  "assumed_latency_s",
      "position_mm",   "accuracy_C", "time_factor", "max_um",  "calibration_span_mm"};
  if (numbers.contains(key) || key.starts_with("measure_position_mm.")) return number_or_text(text);
  if (key == "axes") return list_of(text, false);
  if (key == "target_roi_px") return list_of(text, true);
  if (key == "tls") return text == "true";
  return text;
}

/// Every entry that says where a quantity is read.
template <class Each>
void for_each_source(json& document, const Each& each) {
  for (const SignalRow& row : signal_rows(document)) {
    if (json* entry = node_at(document, row.place); entry != nullptr && entry->is_object()) each(row.place, *entry);
  }
}

void erase_at(json& document, const std::string& place) {
  const auto pointer = pointer_of_path(place);
  if (pointer.empty() || !document.contains(pointer)) return;
  json& parent = document.at(pointer.parent_pointer());
  if (parent.is_array()) {
    parent.erase(static_cast<std::size_t>(std::stoul(pointer.back())));
  } else {
    parent.erase(pointer.back());
  }
}

void remove_sources_of(json& document, const std::string& device) {
  json& sensors = list_at(document, "sensors");
  const auto last = std::remove_if(sensors.begin(), sensors.end(),
                                   [&](const json& sensor) { return text_at(sensor, "device") == device; });
  sensors.erase(last, sensors.end());
  for (const char* key : {"ambient", "speed", "load", "coolant", "compensation_state", "probes"}) {
    if (document.contains(key) && text_at(document[key], "device") == device) document.erase(key);
  }
  for (const char* key : {"positions", "probes"}) {
    if (!document.contains(key) || !document[key].is_object()) continue;
    json kept = json::object();
    for (const auto& [name, entry] : document[key].items()) {
      if (text_at(entry, "device") != device) kept[name] = entry;
    }
    kept.empty() ? static_cast<void>(document.erase(key)) : static_cast<void>(document[key] = kept);
  }
}

void rename_device(json& document, const std::string& before, const std::string& after) {
  if (before.empty()) return;
  for_each_source(document, [&](const std::string&, json& entry) {
    if (text_at(entry, "device") == before) entry["device"] = after;
  });
  if (document.contains("probes") && text_at(document["probes"], "device") == before) {
    document["probes"]["device"] = after;
  }
  if (text_at(document, "control") == before) document["control"] = after;
}

/// The former array of all probes as one entry for each, so that one can be changed.
void spread_probes(json& document) {
  json& probes = document["probes"];
  if (!probes.is_object()) probes = json::object();
  if (!probes.contains("device")) return;
  json each = json::object();
  for (std::size_t i = 0; i < probe_names.size(); ++i) {
    each[probe_names[i]] = {{"device", probes["device"]},
                            {"signal", fmt::format("{}[{}]", text_at(probes, "signal"), i + 1)}};
  }
  probes = std::move(each);
}

/// A module without a port is on the line of the one before; on a line that is there it has the next free unit.
void take_line(json& entry, const json& devices) {
  if (text_at(entry, "kind") != "modbus-rtu") return;
  for (const json& other : devices) {
    if (text_at(entry, "device").empty() && text_at(other, "kind") == "modbus-rtu") {
      for (const char* key : {"device", "baud", "parity", "stop_bits"}) {
        if (other.contains(key)) entry[key] = other[key];
      }
    }
  }
  const std::string port = text_at(entry, "device");
  const auto taken = [&](int unit) {
    return std::any_of(devices.begin(), devices.end(), [&](const json& other) {
      return text_at(other, "device") == port && other.value("unit", json(1)) == json(unit);
    });
  };
  int unit = entry.contains("unit") && entry["unit"].is_number_integer() ? entry["unit"].get<int>() : 1;
  while (!port.empty() && taken(unit)) ++unit;
  entry["unit"] = unit;
}

/// The same file, seen from another folder.
void lead_from(json& object, const char* key, const fs::path& from, const fs::path& to) {
  const std::string name = text_at(object, key);
  std::error_code none;
  if (name.empty() || fs::path(name).is_absolute() || !fs::is_regular_file(from / name, none)) return;
  const fs::path other = fs::relative(from / name, to.empty() ? fs::path(".") : to, none);
  if (!none && !other.empty()) object[key] = other.string();
}

Error at_place(Error error, const std::string& key) {
  const std::string where = error.context.contains("what") ? error.context["what"] : std::string();
  if (error.code == ErrorCode::data_does_not_fit || error.code == ErrorCode::machine_register_unknown) {
    Error placed{ErrorCode::json_bad_value, {{"file", ""}, {"key", key}}};
    const auto word = [&](const char* name, const char* other) {
      const auto at = error.context.find(name);
      return at == error.context.end() ? std::string(other) : at->second;
    };
    placed.context["found"] = word(error.code == ErrorCode::data_does_not_fit ? "found" : "register", "");
    placed.context["expected"] = word("expected", "a register of the device's map");
    return placed;
  }
  error.context["key"] = key;
  return error;
}

/// The maps, and each device with the signals that are read from it, without connecting.
Status check_signals(const json& document, const Profile& profile) {
  if (!profile.manual) {
    if (const auto map = map_of(profile); !map) {
      return fail(at_place(map.error(), place_of_device(document, "") + ".register_map"));
    }
  }
  const auto rows = signal_rows(document);
  for (std::size_t i = 0; i < profile.devices.size(); ++i) {
    const DeviceProfile& device = profile.devices[i];
    const std::string place = place_of_device(document, device.id);
    const bool modbus = device.kind == DeviceKind::modbus;
    if (auto opened = open_device(device, {}); !opened) {
      const bool address = device.kind == DeviceKind::mtconnect && opened.error().code == ErrorCode::data_does_not_fit;
      const char* key = modbus ? ".register_map" : address ? ".url" : ".credentials_file";
      return fail(at_place(opened.error(), place + key));
    }
    for (const SignalRow& row : rows) {
      if (row.source.device != device.id) continue;
      auto opened = open_device(device, {row.source.signal});
      if (!opened) return fail(at_place(opened.error(), row.place + ".signal"));
    }
  }
  return {};
}

}  // namespace

std::string place_of_device(const json& document, const std::string& id) {
  if (id.empty() && document.contains("controller")) return "controller";
  const std::string wanted = id.empty() ? text_at(document, "control") : id;
  const auto devices = document.find("devices");
  if (devices == document.end() || !devices->is_array()) return {};
  for (std::size_t i = 0; i < devices->size(); ++i) {
    const json& device = (*devices)[i];
    const bool by_hand = id.empty() && wanted.empty() && text_at(device, "kind") == "manual";
    if (by_hand || (!wanted.empty() && text_at(device, "id") == wanted)) return fmt::format("devices[{}]", i);
  }
  return {};
}

ProfileDraft::ProfileDraft() : ProfileDraft(json::parse(new_profile), "") {}

ProfileDraft::ProfileDraft(json document, std::string file)
    : m_document(std::move(document)), m_saved(m_document), m_file(std::move(file)) {}

Result<ProfileDraft> ProfileDraft::open(const fs::path& path) {
  ZD_TRY(json document, read_json_file(path));
  if (!document.is_object() || text_at(document, "format") != "zerodrift-profile/1") {
    return fail(ErrorCode::wrong_format,
                {{"file", path.string()}, {"found", text_at(document, "format")}, {"expected", "zerodrift-profile/1"}});
  }
  return ProfileDraft(std::move(document), path.string());
}

template <class Edit>
void ProfileDraft::change(const Edit& edit) {
  json before = m_document;
  try {
    edit();
  } catch (const json::exception&) {  // a file that has text where a list belongs: its reader says so
    m_document = before;
  }
  if (before == m_document) return;
  m_before.push_back(std::move(before));
  m_after.clear();
}

void ProfileDraft::undo() {
  if (m_before.empty()) return;
  m_after.push_back(std::exchange(m_document, std::move(m_before.back())));
  m_before.pop_back();
}

void ProfileDraft::redo() {
  if (m_after.empty()) return;
  m_before.push_back(std::exchange(m_document, std::move(m_after.back())));
  m_after.pop_back();
}

Result<Profile> ProfileDraft::profile() const {
  ZD_TRY(Profile read, profile_from_json(m_document, m_file.empty() ? "profile.json" : m_file));
  ZD_CHECK(check_signals(m_document, read));
  return read;
}

Result<DeviceProfile> ProfileDraft::device(const std::string& place) const {
  const json* entry = node_at(m_document, place);
  if (entry == nullptr) {
    return fail(ErrorCode::json_missing_key, {{"file", m_file}, {"key", place}, {"expected", "an object"}});
  }
  json alone = {{"format", "zerodrift-profile/1"}, {"controller", {{"kind", "manual"}}}, {"devices", {*entry}}};
  json& device = alone["devices"][0];
  if (text_at(device, "kind") == "manual") {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the kind of device " + place}, {"found", "manual"}, {"expected", "a device to read"}});
  }
  if (place == "controller") {
    device["id"] = "control";
    if (!device.contains("register_map")) device["register_map"] = ControllerSettings().register_map;
  }
  auto read = profile_from_json(alone, m_file.empty() ? "profile.json" : m_file);
  if (read) return read->devices.front();
  if (const auto key = read.error().context.find("key"); key != read.error().context.end()) {
    const std::string first = "devices[0]";
    if (key->second.starts_with(first)) key->second = place + key->second.substr(first.size());
  }
  return fail(read.error());
}

std::string ProfileDraft::add_device(json entry) {
  std::string place;
  change([&] {
    json& devices = list_at(m_document, "devices");
    const std::string wanted = text_at(entry, "id");
    const auto taken = [&](const std::string& id) { return has(devices, "id", id); };
    entry["id"] = free_name(wanted.empty() ? "device-" : wanted + "-", "", 1,
                            [&](const std::string& id) { return id.ends_with('-') || taken(id); });
    take_line(entry, devices);
    devices.push_back(std::move(entry));
    place = fmt::format("devices[{}]", devices.size() - 1);
  });
  return place;
}

std::string ProfileDraft::add_camera(const std::string& url) {
  std::string place;
  change([&] {
    json& cameras = list_at(m_document, "cameras");
    const auto taken = [&](const std::string& id) { return has(cameras, "id", id); };
    const std::string id = taken("front") ? free_name("side", "", 2, taken) : "front";
    cameras.push_back({{"id", id},
                       {"url", url},
                       {"axes", {id == "front" ? "X" : "Y", "Z"}},
                       {"target_roi_px", new_region_px},
                       {"pixel_size_known", false}});
    place = fmt::format("cameras[{}]", cameras.size() - 1);
  });
  return place;
}

std::string ProfileDraft::add_sensor(const std::string& device, const std::string& signal) {
  std::string place;
  change([&] {
    json& sensors = list_at(m_document, "sensors");
    const auto taken = [&](const std::string& channel) { return channel == "T_C" || has(sensors, "channel", channel); };
    json sensor = {{"channel", free_name("T", "_C", 1, taken)}};
    if (!device.empty()) sensor["device"] = device;
    if (!signal.empty()) sensor["signal"] = signal;
    sensors.push_back(std::move(sensor));
    place = fmt::format("sensors[{}]", sensors.size() - 1);
  });
  return place;
}

int ProfileDraft::add_sensors_of(const std::string& device) {
  const auto map = map_at(place_of_device(m_document, device));
  if (!map || map->find("temperature_C") == nullptr) return 0;
  const json before = m_document;
  const std::size_t undone = m_before.size();
  int added = 0;
  const auto rows = signal_rows(m_document);
  for (int i = 1; i <= map->find("temperature_C")->count; ++i) {
    const std::string signal = fmt::format("temperature_C[{}]", i);
    const bool read = std::any_of(rows.begin(), rows.end(), [&](const SignalRow& row) {
      return row.source.device == device && row.source.signal == signal;
    });
    if (read) continue;
    add_sensor(device, signal);
    ++added;
  }
  if (added > 0) {  // one step
    m_before.resize(undone);
    m_before.push_back(before);
  }
  return added;
}

void ProfileDraft::remove(const std::string& place) {
  change([&] {
    const json* entry = node_at(m_document, place);
    if (entry == nullptr) return;
    if (place.starts_with("devices[")) remove_sources_of(m_document, text_at(*entry, "id"));
    erase_at(m_document, place);
  });
}

void ProfileDraft::enter(const std::string& place, const std::string& key, const std::string& text) {
  set(place, key, text.empty() ? json() : value_of(key, text));
}

void ProfileDraft::set(const std::string& place, const std::string& key, const json& value) {
  change([&] {
    const std::string full = place.empty() ? key : place + "." + key;
    if (key == "id" && place.starts_with("devices[") && value.is_string()) {
      if (const json* device = node_at(m_document, place); device != nullptr)
        rename_device(m_document, text_at(*device, "id"), value.get<std::string>());
    }
    if (value.is_null()) return erase_at(m_document, full);
    if (!place.empty() && node_at(m_document, place) == nullptr) return;
    m_document[pointer_of_path(full)] = value;
    // Another map by its name takes the place of one that the profile carries.
    if (key == "register_map") erase_at(m_document, place + ".register_map_document");
  });
}

void ProfileDraft::set_kind(const std::string& place, const std::string& kind) {
  change([&] {
    json* entry = node_at(m_document, place);
    if (entry == nullptr || text_at(*entry, "kind") == kind) return;
    const std::string before = text_at(*entry, "kind");
    const bool modbus = kind.starts_with("modbus") && before.starts_with("modbus");
    json next = {{"kind", kind}};
    for (const auto& [key, value] : entry->items()) {
      const bool link = key == "host" || key == "port" || key == "device" || key == "baud" || key == "parity" ||
                        key == "stop_bits" || key == "url" || key == "tls" || key == "ca_file";
      const bool map = key.starts_with("register_map") || key == "unit" || key == "chunk_registers";
      if (key != "kind" && !link && (modbus || !map)) next[key] = value;
    }
    *entry = std::move(next);
  });
}

void ProfileDraft::assign(const std::string& place, const std::string& device, const std::string& signal) {
  change([&] {
    const bool sensor = place.starts_with("sensors[");
    if (place.starts_with("probes.")) spread_probes(m_document);
    if (device.empty() && !sensor) {
      erase_at(m_document, place);
      const std::string parent = place.substr(0, place.find('.'));
      if (const json* rest = node_at(m_document, parent); rest != nullptr && rest->empty())
        erase_at(m_document, parent);
      return;
    }
    json& entry = m_document[pointer_of_path(place)];
    if (!entry.is_object()) entry = json::object();
    entry["device"] = device;
    entry["signal"] = signal;
    if (device.empty()) entry.erase("device");
    if (signal.empty()) entry.erase("signal");
  });
}

Result<RegisterMap> ProfileDraft::map_at(const std::string& place) const {
  ZD_TRY(const DeviceProfile read, device(place));
  if (read.kind != DeviceKind::modbus) {
    return fail(ErrorCode::data_does_not_fit, {{"what", "the kind of device " + read.id},
                                               {"found", read.kind == DeviceKind::mqtt ? "mqtt" : "mtconnect"},
                                               {"expected", "modbus-tcp/modbus-rtu"}});
  }
  Profile alone;
  alone.file = m_file;
  alone.controller = read.modbus;
  return map_of(alone);
}

Status ProfileDraft::set_register(const std::string& place, const std::string& name, const std::string& field,
                                  const std::string& text) {
  ZD_TRY(const RegisterMap map, map_at(place));
  ZD_CHECK(map.require(name).map([](const auto&) {}));
  json document = to_json(map);
  json& entry = document["registers"][name];
  const json value = number_or_text(text);
  entry[field] = value;
  if (field == "scale" && value.is_number()) {
    entry["scale"] = std::abs(value.get<double>());
    entry["sign"] = value.get<double>() < 0.0 ? -1 : 1;
  }
  document.erase("readable");  // where a block ended may be another place now
  ZD_CHECK(register_map_from_json(document, m_file).map([](const auto&) {}));
  set(place, "register_map_document", document);
  return {};
}

Status ProfileDraft::save(const fs::path& path) {
  json document = m_document;
  ZD_CHECK(profile().map([](const auto&) {}));
  if (!m_file.empty() && path.parent_path() != folder()) {
    const auto moved = [&](json& object) {
      for (const char* key : {"register_map", "ca_file", "credentials_file"}) {
        if (object.is_object()) lead_from(object, key, folder(), path.parent_path());
      }
    };
    lead_from(document, "machine", folder(), path.parent_path());
    if (document.contains("controller")) moved(document["controller"]);
    if (document.contains("devices")) {
      for (json& device : document["devices"]) moved(device);
    }
  }
  ZD_CHECK(write_json_file(path, document));
  if (document != m_document) {  // the steps before speak of the old folder
    m_before.clear();
    m_after.clear();
  }
  m_document = std::move(document);
  m_saved = m_document;
  m_file = path.string();
  return {};
}

}  // namespace zerodrift::controller
