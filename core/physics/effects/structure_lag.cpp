// A displacement follows its component's mean temperature late: the sensor sees the surface, the length is the core's.
// Or only what joins the component does, beside its own growth: d += g lag(T_component - T_start, tau2).
#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace structure_lag {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  Observation* seen = observation_of(builder, spec);
  if (seen == nullptr) return;
  if (spec.numbers.count("um_per_K") == 0) {
    seen->lag_s = builder.effect_parameter(spec, index, "lag_s");
    return;
  }
  for (const auto& displacement : builder.machine().displacements) {
    const Component* component = builder.machine().find(displacement.component);
    if (displacement.channel != seen->channel || component == nullptr || component->prescribed) continue;
    StructureTerm term;
    term.gain = builder.effect_parameter(spec, index, "um_per_K");
    term.lag = builder.effect_parameter(spec, index, "second_lag_s", 900.0);
    term.probe = builder.probe(builder.mean_probe(component->id));
    term.probe_reference = builder.reference_C(component->id);
    seen->structure.push_back(term);
  }
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  std::vector<EffectSpec> list;
  for (const auto& displacement : machine.displacements) {
    const Component* component = machine.find(displacement.component);
    if (component == nullptr || component->prescribed || component->length_mm <= 0.0) continue;
    const bool along = displacement.direction == "Z" || displacement.direction == "X";
    if (!component->lump && (!along || is_across(machine, displacement))) continue;
    list.push_back({"structure_lag", true, {{"lag_s", 0.0}}, {{"channel", displacement.channel}}});
    if (!component->lump) continue;  // of a rod the length is simulated
    for (const double lag_s : {300.0, 3000.0}) {
      list.push_back(
          {"structure_lag", true, {{"um_per_K", 0.0}, {"second_lag_s", lag_s}}, {{"channel", displacement.channel}}});
    }
  }
  return list;
}

}  // namespace structure_lag

extern const Effect structure_lag_effect;
const Effect structure_lag_effect = {
    "structure_lag",
    "a structure that follows late",
    "tau dd/dt = d_component - d; or d += g lag(T_component - T_start, tau2) beside its own growth",
    "core of a profile or casting behind its surface, parts bolted to it: minutes to hours; 1 to 12 um per K and metre",
    "A displacement is late against the temperature of its own component; heating and cooling disagree",
    "structure_driver",
    {{"lag_s", 1500.0, 0.0, 40000.0, true},
     {"um_per_K", 5.0, -200.0, 200.0, true},
     {"second_lag_s", 1.2, 1.0, 40000.0, false, 0.0, true}},
    {"lag_s", "um_per_K"},
    structure_lag::add,
    structure_lag::candidates};

}  // namespace zerodrift::physics
