// Changes of machine.json as the form makes them, and its drawing.

#include <QCoreApplication>
#include <algorithm>
#include <cstdlib>

#include "app/desktop/machine_form.h"
#include "app/desktop/machine_typical.h"
#include "core/base/json_path.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

bool entered_yes(const std::string& value) {
  return QString::fromStdString(value) == QCoreApplication::translate("FormWords", "yes");
}

/// A number with a decimal point or comma; else the text, for the reader to refuse.
json entered(const std::string& value) {
  std::string point = value;
  std::replace(point.begin(), point.end(), ',', '.');
  char* end = nullptr;
  const double number = std::strtod(point.c_str(), &end);
  const bool whole = end != nullptr && *end == '\0' && !point.empty();
  return whole ? json(number) : json(value);
}

bool is_text_key(const std::string& key) {
  for (const char* word : {"id", "name", "channel", "component", "direction", "kind"}) {
    if (key == word || key.ends_with(std::string(".") + word)) return true;
  }
  return false;
}

json& array_at(json& object, const char* key) {
  json& list = object[key];
  if (!list.is_array()) list = json::array();
  return list;
}

const json* part_called(const json& machine, const json& id) {
  const auto parts = machine.find("components");
  if (parts == machine.end() || !parts->is_array()) return nullptr;
  for (const json& part : *parts) {
    if (part.is_object() && part.value("id", json()) == id) return &part;
  }
  return nullptr;
}

double half_of(const json* part) {
  return part != nullptr && part->value("length_mm", json()).is_number() ? 0.5 * (*part)["length_mm"].get<double>()
                                                                         : 0.0;
}

bool lump(const json* part) {
  return part != nullptr && part->value("kind", json()) == "lump";
}

/// What speaks of a part by its name follows it.
void rename_part(json& machine, const json& before, const std::string& after) {
  const auto follow = [&](json& object) {
    if (object.is_object() && object.value("component", json()) == before) object["component"] = after;
  };
  for (const char* key : {"sensors", "displacements"}) {
    for (json& one : array_at(machine, key)) follow(one);
  }
  for (json& coupling : array_at(machine, "couplings")) {
    if (!coupling.is_object()) continue;
    for (json& end : array_at(coupling, "between")) follow(end);
  }
}

void edit_film(json& machine, const std::string& value) {
  json& effects = array_at(machine, "effects");
  const auto at = std::find(effects.begin(), effects.end(), json("convection"));
  if (value.empty()) {
    if (at != effects.end()) effects.erase(at);
    if (machine.contains("effect_parameters")) machine["effect_parameters"].erase("convection");
    return;
  }
  if (at == effects.end()) effects.push_back("convection");
  if (!machine["effect_parameters"].is_object()) machine["effect_parameters"] = json::object();
  machine["effect_parameters"]["convection"] = {{"h_W_m2K", entered(value)}};
}

void edit_source_kind(json& source, const std::string& kind) {
  json typical = typical_source(kind);
  for (const char* key : {"id", "from_mm", "to_mm", "channel"}) {
    if (source.contains(key)) typical[key] = source[key];
  }
  source = std::move(typical);
}

std::string free_id(const json& list, const std::string& base) {
  const auto taken = [&](const std::string& id) {
    return std::any_of(list.begin(), list.end(),
                       [&](const json& one) { return one.is_object() && one.value("id", json()) == id; });
  };
  std::string id = base;
  for (int n = 2; taken(id); ++n) id = base + "_" + std::to_string(n);
  return id;
}

json typical_rod() {
  return {{"length_mm", 400}, {"outer_diameter_mm", 100}, {"material", material_of(material_names().front())}};
}

/// Null: all are taken; the reader then asks for one.
json first_unused(const json& list, const std::vector<std::string>& channels) {
  for (const auto& channel : channels) {
    const bool used = std::any_of(list.begin(), list.end(), [&](const json& one) {
      return one.is_object() && one.value("channel", json()) == channel;
    });
    if (!used) return channel;
  }
  return nullptr;
}

double number_at(const json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_number() ? at->get<double>() : 0.0;
}

QString name_at(const json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_string() ? QString::fromStdString(at->get<std::string>()) : QString();
}

ui::SketchPart sketch_part(const json& part) {
  ui::SketchPart drawn{name_at(part, "id"), lump(&part), number_at(part, "length_mm"),
                       number_at(part, "outer_diameter_mm")};
  const auto sources = part.find("heat_sources");
  if (sources == part.end() || !sources->is_array()) return drawn;
  for (const json& source : *sources) {
    if (source.is_object())
      drawn.sources.append({name_at(source, "id"), number_at(source, "from_mm"), number_at(source, "to_mm")});
  }
  return drawn;
}

}  // namespace

FormChannels form_channels(const recording::Recording& run) {
  using recording::ChannelKind;
  FormChannels channels;
  channels.temperatures = run.names(ChannelKind::temperature);
  channels.rooms = run.names(ChannelKind::ambient);
  channels.errors = run.names(ChannelKind::error);
  for (const ChannelKind kind :
       {ChannelKind::speed, ChannelKind::feed, ChannelKind::coolant, ChannelKind::load, ChannelKind::input}) {
    const auto names = run.names(kind);
    channels.inputs.insert(channels.inputs.end(), names.begin(), names.end());
  }
  return channels;
}

json start_description(const FormChannels& channels) {
  json rod = typical_rod();
  rod["id"] = "spindle";
  rod["heat_sources"] = json::array();
  json machine = {{"format", "zerodrift-machine/1"},
                  {"name", ""},
                  {"components", json::array({rod})},
                  {"effects", json::array({"convection"})},
                  {"effect_parameters", {{"convection", {{"h_W_m2K", 10}}}}},
                  {"sensors", json::array()},
                  {"displacements", json::array()}};
  const auto count = static_cast<double>(channels.temperatures.size());
  double number = 0.5;
  for (const auto& channel : channels.temperatures) {
    machine["sensors"].push_back(
        {{"channel", channel}, {"component", "spindle"}, {"position_mm", std::round(400.0 * number / count)}});
    number += 1.0;
  }
  for (const auto& channel : channels.rooms)
    machine["sensors"].push_back({{"channel", channel}, {"component", "ambient"}});
  for (const auto& channel : channels.errors) {
    const std::string letter = channel.size() > 1 && channel[0] == 'd' ? channel.substr(1, 1) : "";
    const bool axis = letter == "X" || letter == "Y" || letter == "Z";
    machine["displacements"].push_back(
        {{"channel", channel}, {"direction", axis ? letter : "unknown"}, {"component", "spindle"}});
  }
  return machine;
}

json* form_node(json& machine, const std::string& path) {
  if (path == "machine") return &machine;
  return node_at(machine, path);
}

void form_edit(json& machine, const std::string& path, const std::string& key, const std::string& value) {
  json* object = form_node(machine, path);
  if (object == nullptr || !object->is_object()) return;
  if (key.starts_with("effect_parameters.convection")) return edit_film(machine, value);
  if (key == "material") {
    if (json material = material_of(QString::fromStdString(value)); !material.is_null())
      (*object)["material"] = material;
    return;
  }
  if (key == "kind" && path.find("heat_sources") != std::string::npos) return edit_source_kind(*object, value);
  if (key == "id" && path.starts_with("components[") && path.find('.') == std::string::npos) {
    rename_part(machine, object->value("id", json()), value);
  }
  if (key == "prescribed" || key == "power_unknown") {
    (*object)[key] = entered_yes(value);
    return;
  }
  const auto pointer = pointer_of_path(key);
  json* holder = object;
  if (key.find('.') != std::string::npos) {
    json& inner = (*object)[pointer.parent_pointer()];
    if (!inner.is_object()) inner = json::object();
    holder = &inner;
  }
  const std::string last = pointer.back();
  if (value.empty()) {
    holder->erase(last);
    return;
  }
  (*holder)[last] = is_text_key(key) ? json(value) : entered(value);
  if (last != "component" || path.starts_with("displacements")) return;
  const json* part = part_called(machine, value);
  if (part == nullptr || lump(part)) {
    holder->erase("position_mm");
  } else if (!holder->contains("position_mm")) {
    (*holder)["position_mm"] = half_of(part);
  }
}

std::string form_add(json& machine, const std::string& kind, const std::string& current, const FormChannels& channels) {
  const auto last = [](const char* list, const json& all) {
    return std::string(list) + "[" + std::to_string(all.size() - 1) + "]";
  };
  json& parts = array_at(machine, "components");
  if (kind == "rod" || kind == "lump") {
    json part = kind == "rod" ? typical_rod() : json{{"kind", "lump"}};
    part["id"] = free_id(parts, kind == "rod" ? "rod" : "housing");
    parts.push_back(std::move(part));
    return last("components", parts);
  }
  if (kind == "source" && !parts.empty()) {
    const std::string path =
        current.starts_with("components[") ? current.substr(0, current.find(']') + 1) : "components[0]";
    json* part = form_node(machine, path);
    if (part == nullptr) return current;
    json& sources = array_at(*part, "heat_sources");
    json source = typical_source("bearing");
    source["id"] = free_id(sources, "bearing");
    if (!lump(part)) {
      const double middle_mm = half_of(part);
      source["from_mm"] = std::max(0.0, middle_mm - 10.0);
      source["to_mm"] = middle_mm + 10.0;
    }
    sources.push_back(std::move(source));
    return path + "." + last("heat_sources", sources);
  }
  if (kind == "coupling" && parts.size() > 1) {
    json coupling = {{"between", json::array()}, {"conductance_W_K", nullptr}};
    for (std::size_t p = parts.size() - 2; p < parts.size(); ++p) {
      json end = {{"component", parts[p].value("id", json())}};
      if (!lump(&parts[p])) end["position_mm"] = half_of(&parts[p]);
      coupling["between"].push_back(std::move(end));
    }
    json& couplings = array_at(machine, "couplings");
    couplings.push_back(std::move(coupling));
    return last("couplings", couplings);
  }
  const json first = parts.empty() ? json("ambient") : parts[0].value("id", json());
  if (kind == "sensor") {
    json& sensors = array_at(machine, "sensors");
    json sensor = {{"channel", first_unused(sensors, channels.temperatures)}, {"component", first}};
    if (const json* part = part_called(machine, first); part != nullptr && !lump(part))
      sensor["position_mm"] = half_of(part);
    sensors.push_back(std::move(sensor));
    return last("sensors", sensors);
  }
  if (kind != "displacement") return current;
  json& displacements = array_at(machine, "displacements");
  displacements.push_back(
      {{"channel", first_unused(displacements, channels.errors)}, {"direction", "Z"}, {"component", first}});
  return last("displacements", displacements);
}

void form_remove(json& machine, const std::string& path) {
  const auto pointer = pointer_of_path(path);
  if (path == "machine" || !machine.contains(pointer)) return;
  const json removed = machine[pointer];
  machine[pointer.parent_pointer()].erase(static_cast<std::size_t>(std::stoul(pointer.back())));
  if (!path.starts_with("components[") || path.find('.') != std::string::npos) return;
  // What joined or measured the part goes with it.
  const json id = removed.is_object() ? removed.value("id", json()) : json();
  const auto of_part = [&](const json& one) { return one.is_object() && one.value("component", json()) == id; };
  for (const char* key : {"sensors", "displacements", "couplings"}) {
    json kept = json::array();
    for (const json& one : array_at(machine, key)) {
      const json ends = one.is_object() ? one.value("between", json::array()) : json::array();
      if (!of_part(one) && std::none_of(ends.begin(), ends.end(), of_part)) kept.push_back(one);
    }
    machine[key] = std::move(kept);
  }
}

ui::Sketch form_sketch(const json& machine, const QString& current) {
  ui::Sketch sketch;
  std::vector<json> ids;
  const auto list = [&](const char* key) {
    const auto at = machine.find(key);
    return at != machine.end() && at->is_array() ? *at : json::array();
  };
  for (const json& part : list("components")) {
    if (!part.is_object()) continue;
    const QString path = QStringLiteral("components[%1]").arg(ids.size());
    if (current == path || current.startsWith(path + QLatin1Char('.'))) sketch.current = static_cast<int>(ids.size());
    ids.push_back(part.value("id", json()));
    sketch.parts.append(sketch_part(part));
  }
  const auto number_of = [&](const json& object) {
    const auto at = std::find(ids.begin(), ids.end(), object.is_object() ? object.value("component", json()) : json());
    return at == ids.end() ? -1 : static_cast<int>(at - ids.begin());
  };
  for (const json& sensor : list("sensors")) {
    const int part = number_of(sensor);
    if (part < 0) continue;
    const double at_mm = number_at(sensor, "position_mm");
    sketch.parts[part].sensors.append({name_at(sensor, "channel").section(QLatin1Char('_'), 0, 0), at_mm, at_mm});
  }
  for (const json& coupling : list("couplings")) {
    const json ends = coupling.is_object() ? coupling.value("between", json::array()) : json::array();
    if (!ends.is_array() || ends.size() != 2 || !ends[0].is_object() || !ends[1].is_object()) continue;
    const double conductance = number_at(coupling, "conductance_W_K");
    sketch.couplings.append({number_of(ends[0]), number_at(ends[0], "position_mm"), number_of(ends[1]),
                             number_at(ends[1], "position_mm"),
                             conductance > 0.0 ? QStringLiteral("%1 W/K").arg(conductance) : QString()});
  }
  for (auto& part : sketch.parts) {
    std::sort(part.sensors.begin(), part.sensors.end(),
              [](const auto& a, const auto& b) { return a.from_mm < b.from_mm; });
  }
  return sketch;
}

}  // namespace zerodrift::desktop
