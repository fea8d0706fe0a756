// A source has a body: its heat first warms a capacity C_b, which passes it on through a contact G_b.
#include <array>

#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace heater_body {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const std::string component = spec.word_or("component", "");
  const std::string source = spec.word_or("source", "");
  if (builder.machine().find(component) == nullptr || source.empty()) return;
  const int capacity = builder.effect_parameter(spec, index, "heat_capacity_J_K");
  const int contact = builder.effect_parameter(spec, index, "contact_W_K", 0.5);
  builder.put_body_before(source, builder.add_node(1.0, capacity, builder.reference_C(component)), contact);
}

double capacity_J_K(const Component& rod) {
  return rod.material.density_kg_m3 * rod.material.heat_capacity_J_kgK * rod.section_m2() * rod.length_mm * 1e-3;
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  constexpr double share_of_rod = 0.2;
  std::vector<EffectSpec> list;
  for (const auto& component : machine.components) {
    if (component.prescribed) continue;
    for (const auto& source : component.sources) {
      const bool motor = source.kind == SourceKind::motor && !component.lump;
      if (!motor && source.kind != SourceKind::input) continue;
      // A rotor or a stator weighs a share of what it turns or stands in, and warms it within minutes.
      const double usual_J_K = motor ? share_of_rod * capacity_J_K(component) : 0.0;
      for (const double contact_W_K :
           motor ? std::array{usual_J_K / 600.0, usual_J_K / 200.0} : std::array{0.15, 0.6}) {
        list.push_back({"heater_body",
                        true,
                        {{"heat_capacity_J_K", 0.0}, {"contact_W_K", contact_W_K}},
                        {{"component", component.id}, {"source", source.id}}});
        if (motor) list.back().numbers["heat_capacity_J_K_prior_sigma"] = usual_J_K;
      }
    }
  }
  return list;
}

}  // namespace heater_body

extern const Effect heater_body_effect;
const Effect heater_body_effect = {
    "heater_body",
    "the heat source's own body",
    "C_b dT_b/dt = Q - G_b (T_b - T)",
    "power resistors, cartridge heaters: 1 to 100 J/K behind 0.05 to 5 W/K; rotors, stators: 0.1 to 10 kJ/K, 1 to 50 "
    "W/K",
    "The heated end starts late and goes on warming after the heater is off",
    "sensor_lag contact_resistance",
    {{"heat_capacity_J_K", 15.0, 0.0, 20000.0, true}, {"contact_W_K", 1.0, 0.005, 100.0, false, 0.0, true}},
    {"heat_capacity_J_K"},
    heater_body::add,
    heater_body::candidates,
    {},
    {.alone = true}};

}  // namespace zerodrift::physics
