// Heat of a lump as a curve over the spindle speed that no simple law describes: ramps between a quarter, half, three
// quarters and full speed, each adding its own heat. Friction does not fall with speed, so no ramp may be negative;
// heat that does fall is left unexplained.
#include <algorithm>
#include <array>

#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace speed_heat_curve {

constexpr std::array<const char*, 4> keys = {"watts_to_25", "watts_25_to_50", "watts_50_to_75", "watts_75_to_100"};

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  std::vector<int> parameters;
  for (const char* key : keys) parameters.push_back(builder.effect_parameter(spec, index, key));
  const int speed = builder.held_speed();
  const double full_rpm = builder.network().full_speed_rpm;
  for_components(builder, spec, [&](const Component& component) {
    Term source = builder.source_over(component.id, 0.0, component.length_mm);
    source.label = component.id + "/speed_heat_curve";
    source.parameters = parameters;
    source.law = [speed, full_rpm](const LawPoint& at) {
      const double n = std::abs(at.held[speed]) / full_rpm;
      Strength s;
      for (std::size_t k = 0; k < keys.size(); ++k) {
        s.by_parameter[k] = std::clamp(4.0 * n - static_cast<double>(k), 0.0, 1.0);
        s.value += at.values[k] * s.by_parameter[k];
      }
      return s;
    };
    builder.add(std::move(source));
  });
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  if (!facts.has_speed) return list;
  for (const auto& component : machine.components) {
    if (!component.lump || component.prescribed) continue;
    EffectSpec spec{"speed_heat_curve", true, {}, {{"component", component.id}}};
    for (const char* key : keys) {
      spec.numbers[key] = 0.0;
      // Against the lump's size: ten kelvin an hour in each quarter.
      spec.numbers[std::string(key) + "_prior_sigma"] = component.heat_capacity_J_K.value_or(1000.0) * 10.0 / 3600.0;
    }
    list.push_back(std::move(spec));
  }
  return list;
}

}  // namespace speed_heat_curve

extern const Effect speed_heat_curve_effect;
const Effect speed_heat_curve_effect = {
    "speed_heat_curve",
    "heat as a curve over speed",
    "+q(n), rising from ramp to ramp",
    "belt drives, gear boxes and seals whose loss has no simple law: 1 to 200 W",
    "At one speed the part is warmer than the laws in n and n^2 can make it beside the other speeds",
    "standing_heat convection",
    {{"watts_to_25", 10.0, 0.0, 1e4, true},
     {"watts_25_to_50", 10.0, 0.0, 1e4, true},
     {"watts_50_to_75", 10.0, 0.0, 1e4, true},
     {"watts_75_to_100", 10.0, 0.0, 1e4, true}},
    {"watts_to_25", "watts_25_to_50", "watts_50_to_75", "watts_75_to_100"},
    speed_heat_curve::add,
    speed_heat_curve::candidates,
    "spindle_rpm",
    {.log_rarity = -3.0}};

}  // namespace zerodrift::physics
