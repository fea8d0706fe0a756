// A source has a body: its heat first warms a capacity C_b, which passes it on through a contact G_b.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace heater_body {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const std::string component = spec.word_or("component", "");
  const std::string source = spec.word_or("source", "");
  if (builder.machine().find(component) == nullptr || source.empty()) return;
  const int capacity = builder.effect_parameter(spec, index, "heat_capacity_J_K");
  const int contact = builder.effect_parameter(spec, index, "contact_W_K", 0.5);
  Term link;
  link.kind = TermKind::link;
  link.law_kind = LawKind::constant;
  link.label = component + "/heater_body";
  link.first_node = builder.add_node(1.0, capacity, builder.reference_C(component));
  link.parameters = {contact};
  link.law = proportional_law;
  builder.put_body_before(source, std::move(link));
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  std::vector<EffectSpec> list;
  for (const auto& component : machine.components) {
    if (component.prescribed) continue;
    for (const auto& source : component.sources) {
      if (source.kind != SourceKind::input) continue;
      for (const double contact_W_K : {0.15, 0.6}) {
        list.push_back({"heater_body",
                        true,
                        {{"heat_capacity_J_K", 0.0}, {"contact_W_K", contact_W_K}},
                        {{"component", component.id}, {"source", source.id}}});
      }
    }
  }
  return list;
}

}  // namespace heater_body

extern const Effect heater_body_effect;
const Effect heater_body_effect = {
    "heater_body",
    "C_b dT_b/dt = Q - G_b (T_b - T)",
    "power resistors, cartridge heaters, motor windings: 1 to 100 J/K behind 0.05 to 5 W/K",
    "The heated end starts late and goes on warming after the heater is off",
    "sensor_lag contact_resistance",
    {{"heat_capacity_J_K", 15.0, 0.0, 2000.0, true}, {"contact_W_K", 1.0, 0.005, 100.0, false, 0.0, true}},
    {"heat_capacity_J_K"},
    heater_body::add,
    heater_body::candidates};

}  // namespace zerodrift::physics
