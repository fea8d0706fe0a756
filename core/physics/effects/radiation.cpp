// Heat radiated to the room: eps sigma (T^4 - T_room^4), written as a film whose coefficient depends on both
// temperatures.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace radiation {

constexpr double stefan_boltzmann = 5.670374419e-8;  // W/(m2 K4)
constexpr double kelvin = 273.15;

Strength law(const LawPoint& at) {
  const double x = at.driver_C + kelvin;
  const double y = at.environment_C + kelvin;
  Strength s;
  s.by_parameter[0] = stefan_boltzmann * (x + y) * (x * x + y * y);
  s.value = at.values[0] * s.by_parameter[0];
  s.by_driver = at.values[0] * stefan_boltzmann * (x * x + y * y + 2.0 * x * (x + y));
  s.by_environment = at.values[0] * stefan_boltzmann * (x * x + y * y + 2.0 * y * (x + y));
  return s;
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const int emissivity = builder.effect_parameter(spec, index, "emissivity");
  for_components(builder, spec, [&](const Component& component) {
    if (!has_surface(component)) return;
    const Term whole = builder.film_over(component.id, 0.0, component.length_mm);
    for (std::size_t i = 0; i < whole.weights.size(); ++i) {
      Term cell;
      cell.kind = TermKind::film;
      cell.law_kind = LawKind::state;
      cell.label = component.id + "/radiation";
      cell.first_node = whole.first_node + static_cast<int>(i);
      cell.weights = {whole.weights[i]};
      cell.driver = {{cell.first_node, 1.0}};
      cell.environment = builder.room();
      cell.parameters = {emissivity};
      cell.law = law;
      builder.add(std::move(cell));
    }
  });
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  if (machine.effect("radiation") != nullptr) return {};
  for (const auto& component : machine.components) {
    if (!component.prescribed && has_surface(component)) return {{"radiation", true, {{"emissivity", 0.0}}, {}}};
  }
  return {};
}

}  // namespace radiation

extern const Effect radiation_effect;
const Effect radiation_effect = {"radiation",
                                 "radiation to the room",
                                 "-eps sigma P (T^4 - T_room^4), temperatures in kelvin",
                                 "Stefan-Boltzmann; eps 0.1 (bright metal) to 0.95 (paint)",
                                 "Like convection, but the hot part loses more than in proportion; below a rise of 20 "
                                 "K a tolerance of the film hides it",
                                 "convection speed_convection",
                                 {{"emissivity", 0.6, 0.0, 1.0, true}},
                                 {"emissivity"},
                                 radiation::add,
                                 radiation::candidates,
                                 {},
                                 {.requires_id = "convection"}};

}  // namespace zerodrift::physics
