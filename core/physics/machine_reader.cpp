#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/physics/effects/effect.h"
#include "core/physics/effects/physical_range.h"
#include "core/physics/machine.h"
#include "core/physics/unknown_sizes.h"

// Ranges are wide enough for anything that stands in a workshop and narrow enough that a unit off by 1000
// (metres for millimetres, kW for W, kJ for J, kelvin for Celsius, um/m for 1/K) falls outside.

namespace zerodrift::physics {
namespace {

using nlohmann::json;

constexpr NumberRange length_range{2.0, 30000.0, false, "a length in mm, 2 to 30000 (is it in metres?)"};
constexpr NumberRange diameter_range{1.0, 5000.0, false, "a diameter in mm, 1 to 5000 (is it in metres?)"};
constexpr NumberRange bore_range{0.0, 5000.0, false, "a diameter in mm, 0 to 5000"};
constexpr NumberRange place_range{0.0, 30000.0, false, "a place in mm from the fixed end"};
constexpr NumberRange conductivity_range{0.1, 2500.0, false, "W/(m K), 0.1 to 2500 (steel has about 45)"};
constexpr NumberRange density_range{100.0, 25000.0, false, "kg/m3, 100 to 25000 (steel has 7850)"};
constexpr NumberRange heat_capacity_range{50.0, 12000.0, false, "J/(kg K), 50 to 12000 (steel has about 460)"};
constexpr NumberRange expansion_range{-2e-5, 5e-4, false, "1/K, up to 5e-4 (steel has 1.15e-5)"};
constexpr NumberRange temperature_range{-60.0, 200.0, false, "degrees Celsius, -60 to 200 (is it in kelvin?)"};
constexpr NumberRange displacement_range{0.0, 1000.0, false, "micrometres, 0 to 1000"};
constexpr NumberRange power_range{10.0, 2e6, false, "watts, 10 to 2000000 (is it in kW?)"};
constexpr NumberRange efficiency_range{0.05, 1.0, false, "a share from 0.05 to 1"};
constexpr NumberRange speed_range{10.0, 500000.0, false, "rpm, 10 to 500000"};
constexpr NumberRange accuracy_range{0.0, 20.0, true, "kelvin, above 0 and up to 20"};
constexpr NumberRange tolerance_range{0.0, 5.0, true, "a share above 0 and up to 5, for example 0.1 for 10 %"};

CoolingJacket read_jacket(JsonObject& o) {
  CoolingJacket jacket;
  jacket.flow_L_min = o.number("flow_L_min", positive);
  jacket.channel_diameter_mm = o.number("channel_diameter_mm", positive);
  jacket.channel_length_mm = o.number("channel_length_mm", positive);
  jacket.area_mm2 =
      o.number_or("area_mm2", 3.14159265358979 * jacket.channel_diameter_mm * jacket.channel_length_mm, positive);
  jacket.conductivity_W_mK = o.number_or("conductivity_W_mK", jacket.conductivity_W_mK, positive);
  jacket.density_kg_m3 = o.number_or("density_kg_m3", jacket.density_kg_m3, positive);
  jacket.heat_capacity_J_kgK = o.number_or("heat_capacity_J_kgK", jacket.heat_capacity_J_kgK, positive);
  jacket.viscosity_mm2_s = o.number_or("viscosity_mm2_s", jacket.viscosity_mm2_s, positive);
  jacket.coolant_temperature_C = o.number_or("coolant_temperature_C", jacket.coolant_temperature_C, temperature_range);
  return jacket;
}

void read_speed_law(JsonObject& o, HeatSource& source) {
  source.channel = o.text_or("channel", "spindle_rpm");
  source.law = o.texts_or_empty("law");
  if (source.law.empty()) source.law = {"on", "n", "n2"};
  for (const auto& term : source.law) {
    if (term != "on" && term != "n" && term != "n2") o.reject("law", term, "a list of on, n, n2");
  }
  if (JsonObject* watts = o.object_if("law_watts")) {
    for (const auto& term : source.law) source.law_watts[term] = watts->number_or(term, 0.0, not_negative);
  }
  source.full_speed_rpm = o.number_or("full_speed_rpm", 0.0, not_negative);
  source.power_unknown = o.flag_or("power_unknown", source.law_watts.empty());
}

HeatSource read_source(JsonObject& o, const Component& component) {
  HeatSource source;
  source.id = o.text("id");
  const std::string kind = o.word("kind", {"motor", "bearing", "input", "speed", "nut", "guide"});
  source.power_unknown = o.flag_or("power_unknown", false);
  if (kind == "motor") {
    source.rated_power_W = o.number("rated_power_W", power_range);
    source.efficiency = o.number("efficiency", efficiency_range);
    source.rated_speed_rpm = o.number("rated_speed_rpm", speed_range);
    if (JsonObject* jacket = o.object_if("cooling_jacket")) source.jacket = read_jacket(*jacket);
  } else if (kind == "bearing") {
    source.kind = SourceKind::bearing;
    source.mean_diameter_mm = o.number("mean_diameter_mm", diameter_range);
    source.f0 = o.number("f0", not_negative);
    source.f1 = o.number("f1", NumberRange{0.0, 0.5, false, "a friction factor from 0 to 0.5 (usual 0.0003 to 0.002)"});
    source.load_N = o.number("load_N", not_negative);
    source.oil_viscosity_mm2_s =
        o.number("oil_viscosity_mm2_s", NumberRange{0.5, 20000.0, false, "mm2/s, 0.5 to 20000"});
  } else if (kind == "input") {
    source.kind = SourceKind::input;
    source.channel = o.text("channel");
    source.watts_per_unit =
        source.power_unknown ? o.number_or("watts_per_unit", 1.0, positive) : o.number("watts_per_unit");
  } else if (kind == "speed") {
    source.kind = SourceKind::speed;
    read_speed_law(o, source);
  } else {
    source.kind = kind == "nut" ? SourceKind::nut : SourceKind::guide;
    source.channel = o.text("channel");
    source.friction_N = o.number("friction_N", positive);
  }
  source.scale = o.number_or("scale", 1.0, not_negative);
  if (!component.lump) {
    source.from_mm = o.number("from_mm", place_range);
    source.to_mm = o.number("to_mm", place_range);
    const std::string inside = fmt::format("a place inside the component, 0 to {:g} mm", component.length_mm);
    if (source.from_mm >= component.length_mm) o.reject("from_mm", fmt::format("{:g}", source.from_mm), inside);
    if (source.to_mm > component.length_mm) o.reject("to_mm", fmt::format("{:g}", source.to_mm), inside);
    if (source.to_mm <= source.from_mm) {
      o.reject("to_mm", fmt::format("{:g}", source.to_mm), fmt::format("more than from_mm ({:g})", source.from_mm));
    }
  }
  return source;
}

void read_inner_body(JsonObject& o, Component& component) {
  constexpr NumberRange share{0.0, 1.0, false, "a share from 0 to 1"};
  InnerBody inner;
  inner.section_share =
      o.number("section_share", NumberRange{0.01, 0.99, false, "a share of the section, 0.01 to 0.99"});
  inner.coupling_W_mK = o.number("coupling_W_mK", positive);
  inner.coupling_rise = o.number_or("coupling_rise", 0.0, not_negative);
  inner.growth_share = o.number_or("growth_share", inner.section_share, share);
  inner.shaft_in_cartridge = o.flag_or("shaft_in_cartridge", false);
  JsonObject* heat_share = o.object_if("heat_share");
  JsonObject* contact_W_K = o.object_if("contact_W_K");
  for (const auto& source : component.sources) {
    if (heat_share != nullptr && heat_share->has(source.id)) {
      inner.heat_share[source.id] = heat_share->number(source.id, share);
    }
    if (contact_W_K != nullptr && contact_W_K->has(source.id)) {
      inner.contact_W_K[source.id] = contact_W_K->number(source.id, positive);
    }
  }
  if (JsonObject* near = o.object_if("near_field_K_W")) {
    for (const auto& channel : near->keys()) inner.near_field_K_W[channel] = near->number(channel);
  }
  inner.near_lag_s = o.number_or("near_lag_s", inner.near_lag_s, not_negative);
  component.inner = std::move(inner);
}

Component read_component(JsonObject& o) {
  Component component;
  component.id = o.text("id");
  component.lump = o.has("kind") && o.word("kind", {"rod", "lump"}) == "lump";
  o.raw("kind");
  component.prescribed = o.flag_or("prescribed", false);
  if (component.lump) {
    component.length_mm = o.number_or("length_mm", 0.0, length_range);
    component.heat_capacity_J_K = o.number_if("heat_capacity_J_K", positive);
    component.area_mm2 = o.number_if("area_mm2", positive);
    if (JsonObject* m = o.object_if("material")) {
      component.material.expansion_1_K = m->number_or("expansion_1_K", 0.0, expansion_range);
    }
  } else {
    component.length_mm = o.number("length_mm", length_range);
    component.outer_diameter_mm = o.number("outer_diameter_mm", diameter_range);
    component.bore_diameter_mm = o.number_or("bore_diameter_mm", 0.0, bore_range);
    if (component.bore_diameter_mm >= component.outer_diameter_mm) {
      o.reject("bore_diameter_mm", fmt::format("{:g}", component.bore_diameter_mm),
               fmt::format("less than outer_diameter_mm ({:g})", component.outer_diameter_mm));
    }
    JsonObject& m = o.object("material");
    component.material.conductivity_W_mK = m.number("conductivity_W_mK", conductivity_range);
    component.material.density_kg_m3 = m.number("density_kg_m3", density_range);
    component.material.heat_capacity_J_kgK = m.number("heat_capacity_J_kgK", heat_capacity_range);
    component.material.expansion_1_K = m.number("expansion_1_K", expansion_range);
  }
  for (JsonObject& s : o.objects_or_empty("heat_sources")) component.sources.push_back(read_source(s, component));
  if (!component.lump) component.conduction_shares = o.numbers_or_empty("conduction_shares");
  for (const double share : component.conduction_shares) {
    if (!(share > 0.0)) o.reject("conduction_shares", fmt::format("{:g}", share), "numbers above 0");
  }
  if (JsonObject* inner = component.lump ? nullptr : o.object_if("inner_body")) read_inner_body(*inner, component);
  return component;
}

CouplingEnd read_end(JsonObject& o, const Machine& machine) {
  CouplingEnd end;
  end.component = o.text("component");
  const Component* component = machine.find(end.component);
  if (component == nullptr) o.reject("component", end.component, "the id of a component");
  if (!component->lump) end.position_mm = o.number("position_mm", place_range);
  if (!component->lump && end.position_mm > component->length_mm) {
    o.reject("position_mm", fmt::format("{:g}", end.position_mm),
             fmt::format("a place inside {}, 0 to {:g} mm", component->id, component->length_mm));
  }
  return end;
}

std::string known_components(const Machine& machine) {
  std::string list = "ambient";
  for (const auto& component : machine.components) list += ", " + component.id;
  return list;
}

void read_sensors(JsonObject& root, Machine& machine, bool make_lumps) {
  for (JsonObject& o : root.objects("sensors")) {
    Sensor sensor;
    sensor.channel = o.text("channel");
    if (machine.sensor(sensor.channel) != nullptr) o.reject("channel", sensor.channel, "a channel named only once");
    sensor.accuracy_C = o.number_or("accuracy_C", 0.1, accuracy_range);
    sensor.lag_s = o.number_or("lag_s", 0.0, not_negative);
    sensor.component = make_lumps ? o.text_or("component", sensor.channel) : o.text("component");
    if (make_lumps && sensor.component != "ambient" && machine.find(sensor.component) == nullptr) {
      Component lump;
      lump.id = sensor.component;
      lump.lump = true;
      machine.components.push_back(lump);
    }
    const Component* component = machine.find(sensor.component);
    if (sensor.component == "ambient") {
      machine.room.channel = sensor.channel;
    } else if (component == nullptr) {
      o.reject("component", sensor.component, "one of " + known_components(machine));
    } else if (!component->lump) {
      sensor.position_mm = o.number("position_mm", any_number);
      if (sensor.position_mm < 0.0 || sensor.position_mm > component->length_mm) {
        o.reject("position_mm", fmt::format("{:g}", sensor.position_mm),
                 fmt::format("a place inside {}, 0 to {:g} mm", component->id, component->length_mm));
      }
    } else {
      o.raw("position_mm");
    }
    machine.sensors.push_back(std::move(sensor));
  }
}

void read_displacements(JsonObject& root, Machine& machine) {
  for (JsonObject& o : root.objects_or_empty("displacements")) {
    Displacement displacement;
    displacement.channel = o.text("channel");
    displacement.direction = o.text_or("direction", "unknown");
    displacement.component = o.text_or("component", "");
    displacement.sign = o.number_or("sign", 1.0);
    displacement.accuracy_um = o.number_or("accuracy_um", 0.0, displacement_range);
    if (!displacement.component.empty() && machine.find(displacement.component) == nullptr) {
      o.reject("component", displacement.component, "one of " + known_components(machine));
    }
    machine.displacements.push_back(std::move(displacement));
  }
}

EffectSpec spec_from(const std::string& id, const json& parameters) {
  EffectSpec spec;
  spec.id = id;
  for (const auto& [key, value] : parameters.items()) {
    if (value.is_number()) spec.numbers[key] = value.get<double>();
    if (value.is_string()) spec.words[key] = value.get<std::string>();
    if (key == "intervals_s" && value.is_array()) {
      for (const json& interval : value) {
        if (interval.is_array() && interval.size() == 2 && interval[0].is_number() && interval[1].is_number())
          spec.intervals_s.emplace_back(interval[0].get<double>(), interval[1].get<double>());
      }
    }
  }
  return spec;
}

/// A place on the component that the effect names, else on the first rod; and nothing that physics forbids.
void check_numbers(const JsonObject& root, const std::string& where, const EffectSpec& spec, const Machine& machine) {
  const std::string named = spec.word_or("component", "");
  const auto at = std::find_if(machine.components.begin(), machine.components.end(), [&](const Component& component) {
    return named.empty() ? !component.lump : component.id == named;
  });
  for (const auto& number : spec.numbers) {
    NumberRange allowed = physical_range(spec.id, number.first);
    std::string words(allowed.words);
    if (number.first == "position_mm" && at != machine.components.end() && !at->lump) {
      allowed.low = 0.0;
      allowed.high = at->length_mm;
      words = fmt::format("a place inside {}, 0 to {:g} mm", at->id, at->length_mm);
    }
    const double value = number.second;
    if (value < allowed.low || value > allowed.high || (allowed.low_open && value == allowed.low)) {
      root.reject(where + "." + number.first, fmt::format("{:g}", value), words);
    }
  }
}

void read_effects(JsonObject& root, Machine& machine) {
  const json* parameters = root.raw("effect_parameters");
  if (parameters != nullptr && !parameters->is_null() && !parameters->is_object()) {
    root.reject("effect_parameters", "something else", "an object with one entry an effect");
  }
  std::map<std::string, std::size_t> seen;
  for (const auto& id : root.texts_or_empty("effects")) {
    if (find_effect(id) == nullptr) root.reject("effects", id, "one of " + effect_ids());
    json own = json::object();
    if (parameters != nullptr && parameters->contains(id)) own = (*parameters)[id];
    // An effect that acts twice (two sensors that lag) has a list of parameter sets, one a time it is listed.
    const std::size_t turn = seen[id]++;
    std::string where = "effect_parameters." + id;
    if (own.is_array()) {
      where += fmt::format("[{}]", turn);
      own = turn < own.size() ? own[turn] : json::object();
    }
    if (!own.is_object()) root.reject("effect_parameters", id, "an object of numbers");
    EffectSpec spec = spec_from(id, own);
    if (own.contains("intervals_s")) {
      const json& given = own["intervals_s"];
      const bool right = given.is_array() && spec.intervals_s.size() == given.size() &&
                         std::all_of(spec.intervals_s.begin(), spec.intervals_s.end(),
                                     [](const auto& one) { return one.first < one.second; });
      if (!right) root.reject(where + ".intervals_s", json_text(given), "a list of [from, to] in s, from before to");
    }
    const auto& required = find_effect(id)->required_numbers;
    const auto given = [&](std::string_view key) { return spec.numbers.count(std::string(key)) != 0; };
    if (!required.empty() && std::none_of(required.begin(), required.end(), given)) {
      root.missing(where + "." + std::string(required.front()), "a number, since the effect is listed");
    }
    if (spec.words.count("component") != 0 && machine.find(spec.words["component"]) == nullptr) {
      root.reject("effect_parameters", spec.words["component"], "a component: " + known_components(machine));
    }
    check_numbers(root, where, spec, machine);
    machine.effects.push_back(std::move(spec));
  }
}

void read_tolerances(JsonObject& root, Machine& machine) {
  JsonObject* o = root.object_if("tolerances");
  if (o == nullptr) return;
  Tolerances& t = machine.tolerances;
  const auto read = [&](const char* key, double& tolerance, double least) {
    tolerance = o->number_or(key, tolerance, tolerance_range);
    if (tolerance >= least) return;
    tolerance = least;
    t.raised.emplace_back(key);
  };
  // What good laboratories reach for the material and for heat that is put in electrically; the film and the contacts
  // of a machine nobody knows so well. Numbers taken for exact would leave all that they miss to some effect.
  read("conductivity", t.conductivity, 0.01);
  read("heat_capacity", t.heat_capacity, 0.01);
  read("heat_source_power", t.heat_source_power, 0.02);
  read("film", t.film, 0.05);
  read("expansion", t.expansion, 0.01);
  read("conductance", t.conductance, 0.05);
}

void read_surroundings(JsonObject& root, Machine& machine) {
  if (JsonObject* o = root.object_if("room")) {
    machine.room.channel = o->text_or("channel", "");
    machine.room.temperature_C = o->number_if("temperature_C", temperature_range);
    machine.room.sigma_C = o->number_or("sigma_C", 0.7, positive);
    o->flag_or("per_recording", true);
  }
  for (JsonObject& o : root.objects_or_empty("fluids")) {
    Fluid fluid;
    fluid.id = o.text("id");
    fluid.temperature_channel = o.text("temperature_channel");
    fluid.flow_channel = o.text_or("flow_channel", "");
    fluid.always_on = o.flag_or("always_on", false);
    machine.fluids.push_back(fluid);
  }
}

Machine read_root(JsonObject& root) {
  Machine machine;
  const std::string format = root.text("format");
  if (format != "zerodrift-machine/1") root.reject("format", format, "zerodrift-machine/1");
  machine.name = root.text_or("name", "");
  machine.initial_temperature_C = root.number_if("initial_temperature_C", temperature_range);
  machine.reference_temperature_C = root.number_if("reference_temperature_C", temperature_range);
  machine.input_timing_sigma_s = root.number_or("input_timing_sigma_s", 0.0, not_negative);
  const bool make_lumps = !root.has("components");
  for (JsonObject& o : root.objects_or_empty("components")) {
    Component component = read_component(o);
    if (machine.find(component.id) != nullptr) o.reject("id", component.id, "an id used only once");
    machine.components.push_back(std::move(component));
  }
  read_surroundings(root, machine);
  read_tolerances(root, machine);
  read_sensors(root, machine, make_lumps);
  read_displacements(root, machine);
  for (JsonObject& o : root.objects_or_empty("couplings")) {
    auto& ends = o.objects("between");
    if (ends.size() != 2) o.reject("between", std::to_string(ends.size()) + " ends", "two ends");
    Coupling coupling;
    coupling.first = read_end(ends[0], machine);
    coupling.second = read_end(ends[1], machine);
    coupling.conductance_W_K = o.number_if("conductance_W_K", not_negative);
    machine.couplings.push_back(coupling);
  }
  read_effects(root, machine);
  return machine;
}

}  // namespace

Result<Machine> machine_from_json(const json& document, const std::string& file, std::vector<std::string>* warnings) {
  ZD_TRY(Machine machine, from_json<Machine>(document, file, warnings, read_root));
  machine.file = file;
  machine.document = json_text(document);
  guess_unknown_sizes(machine);
  return machine;
}

Result<Machine> read_machine(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const json document, read_json_file(path));
  return machine_from_json(document, path.string(), warnings);
}

}  // namespace zerodrift::physics
