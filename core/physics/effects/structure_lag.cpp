// A displacement follows its component's mean temperature late: the sensor sees the surface, the length is the core's.
#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace structure_lag {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  if (Observation* seen = observation_of(builder, spec)) seen->lag_s = builder.effect_parameter(spec, index, "lag_s");
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  std::vector<EffectSpec> list;
  for (const auto& displacement : machine.displacements) {
    const Component* component = machine.find(displacement.component);
    if (component == nullptr || component->prescribed || !component->lump || component->length_mm <= 0.0) continue;
    list.push_back({"structure_lag", true, {{"lag_s", 0.0}}, {{"channel", displacement.channel}}});
  }
  return list;
}

}  // namespace structure_lag

extern const Effect structure_lag_effect;
const Effect structure_lag_effect = {
    "structure_lag",
    "tau dd/dt = d_component - d",
    "core of a profile or casting behind its surface: minutes to hours",
    "A displacement is late against the temperature of its own component; heating and cooling disagree",
    "structure_driver",
    {{"lag_s", 1500.0, 0.0, 40000.0, true}},
    {"lag_s"},
    structure_lag::add,
    structure_lag::candidates};

}  // namespace zerodrift::physics
