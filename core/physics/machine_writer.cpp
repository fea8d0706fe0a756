#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "core/physics/machine.h"

namespace zerodrift::physics {
namespace {

using nlohmann::json;

json& entry(json& list, const std::string& id) {
  if (!list.is_array()) list = json::array();
  for (auto& one : list) {
    if (one.value("id", "") == id) return one;
  }
  list.push_back({{"id", id}});
  return list.back();
}

void write_source(json& out, const HeatSource& source) {
  if (source.scale != 1.0) out["scale"] = source.scale;
  if (!source.law_watts.empty()) {
    out["law_watts"] = source.law_watts;
    out["full_speed_rpm"] = source.full_speed_rpm;
    out["power_unknown"] = source.power_unknown;
  }
}

void write_component(json& out, const Component& component) {
  if (component.lump) {
    out["kind"] = "lump";
    if (component.prescribed) out["prescribed"] = true;
    if (component.heat_capacity_J_K && !component.capacity_is_guessed)
      out["heat_capacity_J_K"] = *component.heat_capacity_J_K;
    if (component.area_mm2 && !component.area_is_guessed) out["area_mm2"] = *component.area_mm2;
  } else {
    out["length_mm"] = component.length_mm;
    out["outer_diameter_mm"] = component.outer_diameter_mm;
    if (component.bore_diameter_mm > 0.0 || out.contains("bore_diameter_mm"))
      out["bore_diameter_mm"] = component.bore_diameter_mm;
    json& material = out["material"];
    material["conductivity_W_mK"] = component.material.conductivity_W_mK;
    material["density_kg_m3"] = component.material.density_kg_m3;
    material["heat_capacity_J_kgK"] = component.material.heat_capacity_J_kgK;
  }
  if (!component.conduction_shares.empty()) out["conduction_shares"] = component.conduction_shares;
  if (component.inner) {
    out["inner_body"] = {{"section_share", component.inner->section_share},
                         {"coupling_W_mK", component.inner->coupling_W_mK},
                         {"coupling_rise", component.inner->coupling_rise},
                         {"growth_share", component.inner->growth_share},
                         {"heat_share", component.inner->heat_share},
                         {"contact_W_K", component.inner->contact_W_K},
                         {"near_field_K_W", component.inner->near_field_K_W},
                         {"near_lag_s", component.inner->near_lag_s},
                         {"shaft_in_cartridge", component.inner->shaft_in_cartridge}};
  }
  if (component.material.expansion_1_K != 0.0) out["material"]["expansion_1_K"] = component.material.expansion_1_K;
  for (const auto& source : component.sources) write_source(entry(out["heat_sources"], source.id), source);
}

/// Of a description without components the parts were made of the sensors, and are named now.
void write_sensor(json& list, const Machine& machine, const Sensor& sensor) {
  if (!list.is_array()) list = json::array();
  auto known = std::find_if(list.begin(), list.end(),
                            [&](const json& one) { return one.value("channel", "") == sensor.channel; });
  if (known == list.end()) {
    list.push_back({{"channel", sensor.channel}, {"accuracy_C", sensor.accuracy_C}});
    known = std::prev(list.end());
  }
  (*known)["component"] = sensor.component;
  const Component* component = machine.find(sensor.component);
  if (component != nullptr && !component->lump) (*known)["position_mm"] = sensor.position_mm;
  if (sensor.lag_s > 0.0) (*known)["lag_s"] = sensor.lag_s;
}

/// What counts as positive; the rest of a displacement is never changed.
void write_sign(json& list, const Displacement& displacement) {
  for (auto& one : list) {
    if (one.value("channel", "") == displacement.channel && one.value("sign", 1.0) != displacement.sign)
      one["sign"] = displacement.sign;
  }
}

void write_effects(json& document, const Machine& machine) {
  json ids = json::array();
  json parameters = json::object();
  std::map<std::string, json> sets;
  for (const auto& spec : machine.effects) {
    ids.push_back(spec.id);
    json own = json::object();
    for (const auto& [key, value] : spec.numbers) own[key] = value;
    for (const auto& [key, value] : spec.words) own[key] = value;
    for (const auto& [from_s, to_s] : spec.intervals_s) own["intervals_s"].push_back({from_s, to_s});
    sets[spec.id].push_back(own);
  }
  for (const auto& [id, list] : sets) parameters[id] = list.size() == 1 ? list[0] : list;
  document["effects"] = ids;
  document["effect_parameters"] = parameters;
}

}  // namespace

json to_json(const Machine& machine) {
  json document = machine.document.empty() ? json::object() : json::parse(machine.document);
  document["format"] = "zerodrift-machine/1";
  document["name"] = machine.name;
  if (machine.initial_temperature_C) document["initial_temperature_C"] = *machine.initial_temperature_C;
  if (machine.reference_temperature_C) document["reference_temperature_C"] = *machine.reference_temperature_C;
  for (const auto& component : machine.components)
    write_component(entry(document["components"], component.id), component);
  for (const Sensor& sensor : machine.sensors) write_sensor(document["sensors"], machine, sensor);
  for (const Displacement& displacement : machine.displacements) {
    if (document.contains("displacements")) write_sign(document["displacements"], displacement);
  }
  for (std::size_t i = 0; i < machine.couplings.size() && document.contains("couplings"); ++i) {
    const auto& g = machine.couplings[i].conductance_W_K;
    if (g) document["couplings"][i]["conductance_W_K"] = *g;
  }
  if (machine.room.channel.empty() && machine.room.temperature_C) {
    document["room"]["temperature_C"] = *machine.room.temperature_C;
  }
  write_effects(document, machine);
  return document;
}

}  // namespace zerodrift::physics
