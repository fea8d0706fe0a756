#include "core/controller/profile_devices.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace zerodrift::controller {
namespace {

constexpr NumberRange period_range{0.01, 3600.0, false, "a time from 0.01 to 3600 s"};
constexpr double stale_periods = 3.0;  // of polling: one answer that is missed is no loss
constexpr double least_stale_s = 10.0;

ControllerSettings read_modbus(JsonObject& o, bool tcp) {
  ControllerSettings c;
  c.kind = tcp ? LinkKind::tcp : LinkKind::rtu;
  if (tcp) {
    c.host = filled(o, "host", "a name or an IP address");
    c.port = o.integer_or("port", 502, 1, 65535);
  } else {
    c.device = filled(o, "device", "a serial port such as /dev/ttyUSB0");
    c.baud = o.integer_or("baud", c.baud, 300, 4000000);
    const std::string parity = o.has("parity") ? o.word("parity", {"N", "E", "O", "none", "even", "odd"}) : "E";
    c.parity = static_cast<char>(std::toupper(static_cast<unsigned char>(parity[0])));
    c.stop_bits = o.integer_or("stop_bits", c.stop_bits, 1, 2);
  }
  c.unit = o.integer_or("unit", 1, 0, 255);
  c.timeout_ms = o.integer_or("timeout_ms", 1000, 20, 60000);
  c.register_map = o.text_or("register_map", c.register_map);
  if (const nlohmann::json* map = o.raw("register_map_document"); map != nullptr && map->is_object()) {
    c.own_map = std::make_shared<const nlohmann::json>(*map);
  }
  c.chunk_registers = o.integer_or("chunk_registers", c.chunk_registers, 8, 123);
  return c;
}

/// The control of the former format, and of a device that is the control. False: it is a person.
void read_control(JsonObject& o, const std::string& kind, Profile& profile) {
  profile.manual = kind == "manual";
  profile.serial = static_cast<std::uint32_t>(o.integer_or("serial", 0, 0, 2147483647));
  if (!profile.manual) profile.controller = read_modbus(o, kind == "modbus-tcp");
}

DeviceProfile read_device(JsonObject& o, const std::string& kind) {
  DeviceProfile device;
  device.id = filled(o, "id");
  device.poll_period_s = o.number_or("poll_period_s", device.poll_period_s, period_range);
  device.stale_after_s =
      o.number_or("stale_after_s", std::max(least_stale_s, stale_periods * device.poll_period_s), period_range);
  if (kind == "mqtt") {
    device.kind = DeviceKind::mqtt;
    device.host = filled(o, "host", "a name or an IP address");
    device.tls = o.flag_or("tls", false);
    device.port = o.integer_or("port", device.tls ? 8883 : device.port, 1, 65535);
    device.ca_file = o.text_or("ca_file", "");
  } else if (kind == "mtconnect") {
    device.kind = DeviceKind::mtconnect;
    device.url = filled(o, "url", "an address such as http://host:5000/");
  } else {
    // A module has no map that could be guessed.
    if (!o.has("register_map") && !o.has("register_map_document")) o.missing("register_map", "a map of its registers");
    device.modbus = read_modbus(o, kind == "modbus-tcp");
    device.timeout_ms = device.modbus.timeout_ms;
    return device;
  }
  device.credentials_file = o.text_or("credentials_file", "");
  device.timeout_ms = o.integer_or("timeout_ms", device.timeout_ms, 20, 60000);
  return device;
}

/// One array of five values, or a source for each probe that there is; the others have none.
template <class Check, class One>
std::vector<SignalSource> read_probes(JsonObject& o, const Check& check, const One& one) {
  JsonObject* entry = o.object_if("probes");
  if (entry == nullptr) return {};
  std::vector<SignalSource> probes;
  if (entry->has("device") || entry->has("signal")) {
    const SignalSource array = read_source(*entry);
    if (array.device.empty()) return {};  // the control's
    check(o, "probes", array, "probes");
    for (std::size_t i = 1; i <= probe_names.size(); ++i) {
      probes.push_back({array.device, fmt::format("{}[{}]", array.signal, i)});
    }
    return probes;
  }
  for (const char* name : probe_names) probes.push_back(one(*entry, name).value_or(SignalSource{}));
  const bool none = std::all_of(probes.begin(), probes.end(), [](const auto& probe) { return probe.device.empty(); });
  return none ? std::vector<SignalSource>() : probes;
}

/// Two that answer at one address are one device, or none.
std::string address_of(const ControllerSettings& c) {
  return c.kind == LinkKind::tcp ? fmt::format("{}:{}, unit {}", c.host, c.port, c.unit)
                                 : fmt::format("{}, unit {}", c.device, c.unit);
}

}  // namespace

std::string filled(JsonObject& o, std::string_view key, const char* expected) {
  if (!o.has(key)) o.missing(key, expected);
  std::string text = o.text(key);
  if (text.empty()) o.missing(key, expected);
  return text;
}

void read_devices(JsonObject& o, Profile& profile) {
  const std::vector<std::string> kinds = {"modbus-tcp", "modbus-rtu", "mqtt", "mtconnect", "manual"};
  const std::string control = o.text_or("control", "");
  bool has_control = o.has("controller");
  if (has_control) {
    JsonObject& controller = o.object("controller");
    read_control(controller, controller.word("kind", {"modbus-tcp", "modbus-rtu", "manual"}), profile);
  }
  std::map<std::string, std::size_t> places;  // of the ids
  for (JsonObject& entry : o.objects_or_empty("devices")) {
    const std::string id = filled(entry, "id");
    const std::string kind = entry.word("kind", kinds);
    if (!places.emplace(id, places.size()).second) entry.reject("id", id, "a name that no other device has");
    if (kind != "manual" && id != control) {
      profile.devices.push_back(read_device(entry, kind));
      continue;
    }
    if (has_control) entry.reject("kind", kind, "one control only; this profile has another one");
    if (kind == "mqtt" || kind == "mtconnect")
      entry.reject("kind", kind, "a control: modbus-tcp, modbus-rtu or manual");
    read_control(entry, kind, profile);
    has_control = true;
  }
  if (!control.empty() && !places.contains(control)) o.reject("control", control, "the id of one of the devices");
  if (!has_control) {
    o.missing("controller", "the control: modbus-tcp, modbus-rtu or manual, here or among the devices");
  }
  std::map<std::string, std::string> taken;
  if (!profile.manual) taken[address_of(profile.controller)] = "the control";
  for (const DeviceProfile& device : profile.devices) {
    if (device.kind != DeviceKind::modbus) continue;
    const std::string address = address_of(device.modbus);
    if (!taken.emplace(address, device.id).second) {
      o.reject(fmt::format("devices[{}].unit", places.at(device.id)), fmt::format("{} at {}", device.id, address),
               "an address that is not that of " + taken[address]);
    }
  }
}

SignalSource read_source(JsonObject& o) {
  SignalSource source{o.text_or("device", ""), o.text_or("signal", "")};
  if (!source.device.empty() && source.signal.empty()) {
    o.missing("signal", "which signal of device " + source.device + " it is");
  }
  return source;
}

void read_signals(JsonObject& o, Profile& profile) {
  std::map<std::string, std::string> used;  // device and signal -> for what
  const auto check = [&](JsonObject& at, const std::string& key, const SignalSource& source, const std::string& what) {
    if (source.device.empty()) return;
    if (find_device(profile, source.device) == nullptr) {
      at.reject(key + ".device", source.device, "the id of one of the devices that are read");
    }
    const auto [other, is_new] = used.emplace(source.device + " " + source.signal, what);
    if (!is_new) at.reject(key + ".signal", source.signal, "a signal that is not " + other->second + " already");
  };
  const auto one = [&](JsonObject& parent, const std::string& key) -> std::optional<SignalSource> {
    JsonObject* entry = parent.object_if(key);
    if (entry == nullptr) return std::nullopt;
    const SignalSource source = read_source(*entry);
    if (source.device.empty()) return std::nullopt;  // the control's, as without the entry
    check(parent, key, source, key);
    return source;
  };
  SignalSources& sources = profile.sources;
  sources.ambient = one(o, "ambient");
  sources.speed = one(o, "speed");
  sources.load = one(o, "load");
  sources.coolant = one(o, "coolant");
  sources.compensation_state = one(o, "compensation_state");
  if (JsonObject* positions = o.object_if("positions"); positions != nullptr) {
    for (const std::string& axis : positions->keys()) {
      if (const auto source = one(*positions, axis)) sources.positions[axis] = *source;
    }
  }
  sources.probes = read_probes(o, check, one);
  std::set<std::string> channels;
  for (std::size_t i = 0; i < profile.sensors.size(); ++i) {
    const SensorProfile& sensor = profile.sensors[i];
    const std::string key = fmt::format("sensors[{}]", i);
    check(o, key, sensor.source, sensor.channel);
    if (!channels.insert(sensor.channel).second) {
      o.reject(key + ".channel", sensor.channel, "a channel that no other sensor has");
    }
    if (profile.manual && sensor.source.device.empty()) {
      o.missing(key + ".device", "the device that reads it: a manual control reads nothing");
    }
  }
}

const DeviceProfile* find_device(const Profile& profile, const std::string& id) {
  for (const DeviceProfile& device : profile.devices) {
    if (device.id == id) return &device;
  }
  return nullptr;
}

}  // namespace zerodrift::controller
