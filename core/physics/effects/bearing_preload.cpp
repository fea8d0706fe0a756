// The preload is not what the description says: it grows as the bearing warms, with the square of the speed (balls
// pressed outwards), or is another constant: P = P0 (1 + kT (T - T0) + kn (n / n_full)^2 + k0).
#include "core/physics/effects/bearings.h"

namespace zerodrift::physics {
namespace bearing_preload {

struct Form {
  const char* key;
  BearingModifier::Kind kind;
};

constexpr Form forms[] = {{"growth_1_K", BearingModifier::Kind::preload_temperature},
                          {"speed_share", BearingModifier::Kind::preload_speed},
                          {"constant_share", BearingModifier::Kind::preload_constant}};

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  for (const auto& form : forms) {
    if (spec.numbers.count(form.key) == 0) continue;
    BearingModifier m;
    m.kind = form.kind;
    m.parameter = builder.effect_parameter(spec, index, form.key);
    m.reference_C = builder.law_reference_C();
    modify_bearings(builder, spec, m);
  }
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  if (!facts.has_speed || machine.effect("bearing_preload") != nullptr) return list;
  std::vector<std::string> where = bearings_of(machine);
  if (where.size() > 1) where.insert(where.begin(), "");
  for (const auto& bearing : where) {
    for (const auto& form : forms) {
      EffectSpec spec{"bearing_preload", true, {{form.key, 0.0}}, {}};
      if (!bearing.empty()) spec.words["bearing"] = bearing;
      list.push_back(spec);
    }
  }
  return list;
}

}  // namespace bearing_preload

extern const Effect bearing_preload_effect;
const Effect bearing_preload_effect = {
    "bearing_preload",
    "a different bearing preload",
    "P = P0 (1 + kT (T_bearing - T0) + kn (n / n_full)^2 + k0) in M1 = f1 P dm",
    "Palmgren; thermally induced preload of spindle bearings (Stein and Tu 1994)",
    "Bearings are simulated too cold - with less load than described, too hot - "
    "more so the warmer or the faster they run",
    "bearing_viscosity extra_heat_source",
    {{"growth_1_K", 0.04, 0.0, 0.8, true},
     {"speed_share", 1.0, 0.0, 20.0, true},
     {"constant_share", 0.8, -0.8, 16.0, true}},
    {"growth_1_K", "speed_share", "constant_share"},
    bearing_preload::add,
    bearing_preload::candidates,
    "spindle_rpm",
    {},
    {{"growth_1_K", "bearing_preload_heat", "bearing preload that grows with the heat"},
     {"speed_share", "bearing_preload_speed", "bearing preload that grows with speed"}}};

}  // namespace zerodrift::physics
