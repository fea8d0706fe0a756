// A constant source in a lump, also while the machine stands: cabinets, hydraulics, lamps.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace standing_heat {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const int power = builder.effect_parameter(spec, index, "power_W");
  for_components(builder, spec, [&](const Component& component) {
    Term source = builder.source_over(component.id, 0.0, component.length_mm);
    source.label = component.id + "/standing_heat";
    source.law_kind = LawKind::constant;
    source.parameters = {power};
    source.law = proportional_law;
    builder.add(std::move(source));
  });
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  std::vector<EffectSpec> list;
  for (const auto& component : machine.components) {
    if (!component.lump || component.prescribed) continue;
    const double capacity_J_K = component.heat_capacity_J_K.value_or(1000.0);
    list.push_back({"standing_heat",
                    true,
                    {{"power_W", 0.0}, {"power_W_prior_sigma", capacity_J_K * 20.0 / 3600.0}},
                    {{"component", component.id}}});
  }
  return list;
}

}  // namespace standing_heat

extern const Effect standing_heat_effect;
const Effect standing_heat_effect = {"standing_heat",
                                     "a heat that is there at rest as well",
                                     "+q, constant",
                                     "electric cabinets, hydraulic units, lamps",
                                     "The part is warmer than its surroundings even before the machine runs",
                                     "extra_heat_source convection",
                                     {{"power_W", 20.0, 0.0, 1e5, true}},
                                     {"power_W"},
                                     standing_heat::add,
                                     standing_heat::candidates};

}  // namespace zerodrift::physics
