// Behind the surface that the sensor sees lies a slower core: C_core dT_core/dt = G (T - T_core).
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace casting_core {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const int conductance = builder.effect_parameter(spec, index, "conductance_W_K");
  const int capacity = builder.effect_parameter(spec, index, "heat_capacity_J_K", 3000.0);
  for_components(builder, spec, [&](const Component& component) {
    if (!component.lump) return;
    Term link;
    link.kind = TermKind::link;
    link.law_kind = LawKind::constant;
    link.label = component.id + "/casting_core";
    const int core = builder.add_node(1.0, capacity, builder.reference_C(component.id));
    link.links = {{builder.place(component.id).first, core, 1.0}};
    link.parameters = {conductance};
    link.law = proportional_law;
    builder.add(std::move(link));
  });
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  std::vector<EffectSpec> list;
  for (const auto& component : machine.components) {
    if (!component.lump || component.prescribed) continue;
    const double capacity_J_K = component.heat_capacity_J_K.value_or(1000.0);
    list.push_back({"casting_core",
                    true,
                    {{"conductance_W_K", 0.0},
                     {"conductance_W_K_prior_sigma", capacity_J_K / 2000.0},
                     {"heat_capacity_J_K", 3.0 * capacity_J_K}},
                    {{"component", component.id}}});
  }
  return list;
}

}  // namespace casting_core

extern const Effect casting_core_effect;
const Effect casting_core_effect = {
    "casting_core",
    "a slow core behind the surface",
    "C_core dT_core/dt = G (T - T_core)",
    "castings whose walls warm before their ribs: minutes to hours",
    "A surface starts fast and then goes on slowly, on the way up and on the way down",
    "convection sensor_lag",
    {{"conductance_W_K", 0.5, 0.0, 200.0, true}, {"heat_capacity_J_K", 0.8, 1.0, 1e7, false, 0.0, true}},
    {"conductance_W_K"},
    casting_core::add,
    casting_core::candidates,
    {},
    {.log_rarity = -3.0, .requires_id = "convection"}};

}  // namespace zerodrift::physics
