// The oil thins as the bearing warms: nu = nu0 exp(-beta (T_bearing - T_ref)) in Palmgren's viscous torque.
#include "core/physics/effects/bearings.h"

namespace zerodrift::physics {
namespace bearing_viscosity {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  BearingModifier m;
  m.kind = BearingModifier::Kind::viscosity;
  m.parameter = builder.effect_parameter(spec, index, "beta_1_K");
  m.reference_C = spec.number_or("reference_C", builder.law_reference_C());
  modify_bearings(builder, spec, m);
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  if (!facts.has_speed || bearings_of(machine).empty() || machine.effect("bearing_viscosity") != nullptr) return {};
  // The grade may be stated at the start temperature or, as catalogues do, at 40 C.
  EffectSpec at_start{"bearing_viscosity", true, {{"beta_1_K", 0.0}}, {}};
  EffectSpec at_40{"bearing_viscosity", true, {{"beta_1_K", 0.0}, {"reference_C", 40.0}}, {}};
  return {at_start, at_40};
}

}  // namespace bearing_viscosity

extern const Effect bearing_viscosity_effect;
const Effect bearing_viscosity_effect = {
    "bearing_viscosity",
    "bearing oil that thins as it warms",
    "nu = nu0 exp(-beta (T_bearing - T_ref)) in M0 = 1e-7 f0 (nu n)^(2/3) dm^3",
    "Palmgren; oil viscosity over temperature, beta 0.02 to 0.05 1/K near 40 C (ISO 3448, ASTM D341)",
    "Bearings are simulated too cold at first and too hot later; friction falls as the oil warms",
    "bearing_preload speed_convection",
    {{"beta_1_K", 0.03, 0.0, 0.09, true}},
    {"beta_1_K"},
    bearing_viscosity::add,
    bearing_viscosity::candidates,
    "spindle_rpm"};

}  // namespace zerodrift::physics
