// Cooling by a liquid while it flows: -c(t) h P (T - T_coolant) over a region. A fluid that the description measures is
// used with its own temperature and flow; a lump of unknown surface has a conductance instead of a film.
#include <numeric>

#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace coolant {

/// What one film has too much is taken off by another.
Law opposite(const Law& law) {
  return [law](const LawPoint& at) {
    Strength s = law(at);
    s.value = -s.value;
    s.by_driver = -s.by_driver;
    s.by_environment = -s.by_environment;
    for (double& by : s.by_parameter) by = -by;
    return s;
  };
}

/// An edge of the region: what a jet reaches is not what a drawing shows.
int edge(NetworkBuilder& builder, const EffectSpec& spec, int index, const std::string& key, double low, double high) {
  const int parameter = builder.effect_parameter(spec, index, key);
  Parameter& p = builder.network().parameters[static_cast<std::size_t>(parameter)];
  p.low = low;
  p.high = high;
  return parameter;
}

/// A conductance that is spread as the surface is, or evenly where no surface is known.
void share_out(std::vector<double>& weights) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& weight : weights) weight = sum > 0.0 ? weight / sum : 1.0 / static_cast<double>(weights.size());
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const bool by_conductance = spec.numbers.count("conductance_W_K") != 0;
  const int strength = builder.effect_parameter(spec, index, by_conductance ? "conductance_W_K" : "h_W_m2K");
  Environment liquid;
  liquid.name = "coolant";
  std::string flow = "coolant_on";
  bool always_on = false;
  const std::string fluid_id = spec.word_or("fluid", "");
  for (const auto& fluid : builder.machine().fluids) {
    if (fluid.id != fluid_id) continue;
    liquid.series = builder.linear(fluid.temperature_channel);
    always_on = fluid.always_on;
    if (!fluid.flow_channel.empty()) flow = fluid.flow_channel;
  }
  if (liquid.series < 0) {
    liquid.parts.push_back({builder.effect_parameter(spec, index, "temperature_C", builder.law_reference_C()), -1});
    // A tank without a chiller follows the room, one with a chiller does not.
    Parameter follows;
    follows.key = "follows_room";
    follows.component = spec.word_or("component", "");
    follows.effect = index;
    follows.mean = 0.5;
    follows.start = spec.number_or(follows.key, follows.mean);
    follows.sigma = spec.candidate ? 0.4 : 0.0;
    follows.low = 0.0;
    follows.high = 1.0;
    liquid.parts.push_back({builder.add_parameter(follows), room_rise_signal(builder, builder.law_reference_C())});
  }
  const int environment = builder.environment(std::move(liquid));
  for_components(builder, spec, [&](const Component& component) {
    if (!by_conductance && !has_surface(component)) return;
    const double from_mm = spec.number_or("from_mm", 0.0);
    const double to_mm = std::min(component.length_mm, spec.number_or("to_mm", component.length_mm));
    const auto put = [&](Term film, bool minus) {
      film.label = component.id + "/coolant";
      film.environment = environment;
      film.parameters = {strength};
      film.law_kind = always_on ? LawKind::constant : LawKind::inputs;
      film.law = always_on ? Law(proportional_law) : times_input(builder.held(flow));
      if (minus) film.law = opposite(film.law);
      builder.add(std::move(film));
    };
    if (spec.candidate && spec.numbers.count("from_mm") != 0 && !component.lump) {
      const double middle_mm = 0.5 * (from_mm + to_mm);
      const int from = edge(builder, spec, index, "from_mm", 0.0, middle_mm);
      const int to = edge(builder, spec, index, "to_mm", middle_mm, component.length_mm);
      put(builder.film_up_to(component.id, to), false);
      put(builder.film_up_to(component.id, from), true);
      return;
    }
    Term film = builder.film_over(component.id, from_mm, to_mm);
    if (by_conductance) share_out(film.weights);
    put(std::move(film), false);
  });
}

void add_regions(const Component& component, std::vector<EffectSpec>& list) {
  const double edge_mm = 0.1 * component.length_mm;
  const auto region = [&](const std::string& name, double from_mm, double to_mm) {
    list.push_back({"coolant",
                    true,
                    {{"h_W_m2K", 0.0},
                     {"from_mm", std::max(0.0, from_mm)},
                     {"to_mm", std::min(component.length_mm, to_mm)},
                     {"from_mm_prior_sigma", edge_mm},
                     {"to_mm_prior_sigma", edge_mm}},
                    {{"component", component.id}, {"region", name}}});
  };
  region("all", 0.0, component.length_mm);
  const double margin_mm = 0.06 * component.length_mm;
  std::vector<const HeatSource*> bearings;
  for (const auto& source : component.sources) {
    if (source.kind == SourceKind::motor) region("motor", source.from_mm, source.to_mm);
    if (source.kind != SourceKind::bearing) continue;
    bearings.push_back(&source);
    region("at_" + source.id, source.from_mm - margin_mm, source.to_mm + margin_mm);
  }
  region("front_half", 0.5 * component.length_mm, component.length_mm);
  region("rear_half", 0.0, 0.5 * component.length_mm);
  if (bearings.size() > 1) region("between", bearings.front()->from_mm, bearings.back()->to_mm);
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  for (const auto& component : machine.components) {
    if (component.prescribed) continue;
    for (const auto& fluid : machine.fluids) {
      bool own = false;  // a component cannot be cooled by a fluid whose temperature is its own sensor
      for (const auto& sensor : machine.sensors) {
        own = own || (sensor.component == component.id && sensor.channel == fluid.temperature_channel);
      }
      const bool listed = [&] {
        for (const auto& spec : machine.effects) {
          if (spec.id == "coolant" && spec.word_or("component", "") == component.id) return true;
        }
        return false;
      }();
      if (own || listed) continue;
      list.push_back({"coolant",
                      true,
                      {{has_surface(component) ? "h_W_m2K" : "conductance_W_K", 0.0}},
                      {{"component", component.id}, {"fluid", fluid.id}}});
    }
    if (facts.has_coolant && !component.lump && machine.effect("coolant") == nullptr) add_regions(component, list);
  }
  return list;
}

}  // namespace coolant

extern const Effect coolant_effect;
const Effect coolant_effect = {
    "coolant",
    "cooling by the coolant",
    "-c(t) h P (T - T_coolant) over a region",
    "forced liquid film, 50 to 1500 W/(m2 K) (VDI Heat Atlas G)",
    "The simulation is too hot from the moment the coolant runs; the error steps with coolant_on",
    "extra_heat_source convection",
    {{"h_W_m2K", 60.0, 0.0, 1500.0, true},
     {"conductance_W_K", 0.5, 0.0, 200.0, true},
     {"temperature_C", 2.0, -20.0, 90.0},
     {"from_mm", 50.0},
     {"to_mm", 50.0}},
    {"h_W_m2K", "conductance_W_K"},
    coolant::add,
    coolant::candidates,
    "coolant_on"};

}  // namespace zerodrift::physics
