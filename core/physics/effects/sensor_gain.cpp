// One sensor's rise is wrong in proportion: a wrong characteristic, or a sensor that half sees the air.
#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace sensor_gain {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  if (Observation* seen = observation_of(builder, spec))
    seen->gain = builder.effect_parameter(spec, index, "gain_error");
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  return one_a_sensor(machine, facts, "sensor_gain", "gain_error");
}

}  // namespace sensor_gain

extern const Effect sensor_gain_effect;
const Effect sensor_gain_effect = {"sensor_gain",
                                   "a sensor that reads its rise wrong",
                                   "y = T0 + (1 + g) (T - T0)",
                                   "wrong characteristic, poor contact: 2 to 30 %",
                                   "One channel is off in proportion to its rise, in step with it. A sensor that "
                                   "touches its part badly looks the same",
                                   "contact_resistance sensor_lag",
                                   {{"gain_error", 0.08, -0.3, 0.3, true}},
                                   {"gain_error"},
                                   sensor_gain::add,
                                   sensor_gain::candidates,
                                   {},
                                   {.log_rarity = -3.0}};

}  // namespace zerodrift::physics
