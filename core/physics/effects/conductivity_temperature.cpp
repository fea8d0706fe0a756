// The material conducts less (or more) as it warms: k = k0 (1 + b (T - T0)).
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace conductivity_temperature {

Law face_law(double section_over_cell_m, double reference_C) {
  return [=](const LawPoint& at) {
    Strength s;
    const double rise_K = at.driver_C - reference_C;
    s.value = at.values[1] * section_over_cell_m * at.values[0] * rise_K;
    s.by_parameter[0] = at.values[1] * section_over_cell_m * rise_K;
    s.by_parameter[1] = section_over_cell_m * at.values[0] * rise_K;
    s.by_driver = at.values[1] * section_over_cell_m * at.values[0];
    return s;
  };
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const int slope = builder.effect_parameter(spec, index, "slope_1_K");
  for_components(builder, spec, [&](const Component& component) {
    if (component.lump) return;
    const auto at = builder.place(component.id);
    for (int face = 1; face < at.count; ++face) {
      // The inside of a rod of two bodies follows nearly the same gradient; one term on the surface stands for both.
      Term term;
      term.kind = TermKind::link;
      term.law_kind = LawKind::state;
      term.label = component.id + "/conductivity_temperature";
      term.links = {{at.first + face - 1, at.first + face, 1.0}};
      term.driver = {{at.first + face - 1, 0.5}, {at.first + face, 0.5}};
      term.parameters = {slope, builder.conductivity(component.id)};
      term.law = face_law(component.section_m2() / at.cell_m, builder.law_reference_C());
      builder.add(std::move(term));
    }
  });
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  if (machine.effect("conductivity_temperature") != nullptr) return {};
  for (const auto& component : machine.components) {
    if (!component.lump) return {{"conductivity_temperature", true, {{"slope_1_K", 0.0}}, {}}};
  }
  return {};
}

}  // namespace conductivity_temperature

extern const Effect conductivity_temperature_effect;
const Effect conductivity_temperature_effect = {
    "conductivity_temperature",
    "conductivity that changes with temperature",
    "k = k0 (1 + b (T - T0))",
    "steels -2e-4 to -1e-3 1/K, cast iron and ceramics up to -2e-3 1/K (Touloukian)",
    "The hot parts conduct otherwise than the cold ones; gradients do not grow in proportion to the heat",
    "radiation bearing_preload",
    {{"slope_1_K", 0.0015, -0.006, 0.006, true}},
    {"slope_1_K"},
    conductivity_temperature::add,
    conductivity_temperature::candidates,
    {},
    {.log_rarity = -3.0}};

}  // namespace zerodrift::physics
