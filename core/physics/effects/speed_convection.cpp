// The air film of a turning part grows with its speed: h = h0 + a (n / n_full)^m.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace speed_convection {

Law law(int speed, double full_rpm) {
  return [=](const LawPoint& at) {
    Strength s;
    const double relative = std::abs(at.held[speed]) / full_rpm;
    if (relative < 1e-6) return s;
    s.by_parameter[0] = std::pow(relative, at.values[1]);
    s.value = at.values[0] * s.by_parameter[0];
    s.by_parameter[1] = s.value * std::log(relative);
    return s;
  };
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const int strength = builder.effect_parameter(spec, index, "a_W_m2K");
  const int exponent = builder.effect_parameter(spec, index, "exponent", 0.7);
  for_components(builder, spec, [&](const Component& component) {
    if (!has_surface(component)) return;
    Term film = builder.film_over(component.id, 0.0, component.length_mm);
    film.label = component.id + "/speed_convection";
    film.environment = builder.room();
    film.parameters = {strength, exponent};
    film.law = law(builder.held_speed(), builder.network().full_speed_rpm);
    builder.add(std::move(film));
  });
}

/// Over all surfaces together, or over one part's: a motor with its fan on the shaft, a chuck.
std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  if (!facts.has_speed) return {};
  const EffectSpec everywhere{"speed_convection", true, {{"a_W_m2K", 0.0}, {"exponent", 0.7}}, {}};
  std::vector<EffectSpec> list;
  for (const auto& component : machine.components) {
    if (component.prescribed || !has_surface(component)) continue;
    list.push_back(everywhere);
    list.back().words["component"] = component.id;
  }
  if (list.size() > 1 && machine.effect("speed_convection") == nullptr) list.push_back(everywhere);
  return list;
}

}  // namespace speed_convection

extern const Effect speed_convection_effect;
const Effect speed_convection_effect = {
    "speed_convection",
    "convection that grows with speed",
    "-a (n / n_full)^m P (T - T_room)",
    "rotating cylinder in air, Nu ~ Re^m with m 0.6 to 0.8 (Kays and Bjorklund 1958)",
    "The simulation is too hot while the spindle turns and right while it stands",
    "bearing_viscosity convection",
    {{"a_W_m2K", 30.0, 0.0, 400.0, true}, {"exponent", 0.15, 0.4, 1.1, false, 0.7}},
    {"a_W_m2K"},
    speed_convection::add,
    speed_convection::candidates,
    "spindle_rpm",
    {.requires_id = "convection"}};

}  // namespace zerodrift::physics
