// A film that a logged input drives: a fan, a door, a valve, compressed air. The description has no use for that
// column.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace film_driver {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const std::string driver = spec.word_or("driver", "");
  if (driver.empty()) return;
  const bool by_conductance = spec.numbers.count("conductance_W_K") != 0;
  const int strength = builder.effect_parameter(spec, index, by_conductance ? "conductance_W_K" : "h_W_m2K");
  // The strength holds where the input is at its full value.
  const double full = spec.number_or("full", 1.0);
  const int input = builder.held(driver);
  for_components(builder, spec, [&](const Component& component) {
    if (!by_conductance && !has_surface(component)) return;
    Term film = builder.film_over(component.id, 0.0, component.length_mm);
    if (by_conductance)
      for (double& weight : film.weights) weight = 1.0 / static_cast<double>(film.weights.size());
    film.label = component.id + "/film_driver";
    film.environment = builder.room();
    film.parameters = {strength};
    film.law = [input, full](const LawPoint& at) {
      Strength s;
      s.by_parameter[0] = at.held[input] / full;
      s.value = at.values[0] * s.by_parameter[0];
      return s;
    };
    builder.add(std::move(film));
  });
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  for (const auto& [driver, full] : facts.unused_inputs) {
    for (const auto& component : machine.components) {
      if (component.prescribed) continue;
      list.push_back({"film_driver",
                      true,
                      {{has_surface(component) ? "h_W_m2K" : "conductance_W_K", 0.0}, {"full", full}},
                      {{"component", component.id}, {"driver", driver}}});
    }
  }
  return list;
}

}  // namespace film_driver

extern const Effect film_driver_effect;
const Effect film_driver_effect = {"film_driver",
                                   "a film that a logged input drives",
                                   "-h (u / u_full) P (T - T_room)",
                                   "fans and blowers: films of 20 to 150 W/(m2 K) (VDI Heat Atlas G)",
                                   "The part cools faster while a logged input is on that the description does not use",
                                   "convection coolant",
                                   {{"h_W_m2K", 40.0, 0.0, 1500.0, true}, {"conductance_W_K", 0.5, 0.0, 200.0, true}},
                                   {"h_W_m2K", "conductance_W_K"},
                                   film_driver::add,
                                   film_driver::candidates};

}  // namespace zerodrift::physics
