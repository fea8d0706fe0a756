// A slow sensor: its reading follows the temperature with a first-order lag.
#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace sensor_lag {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  if (Observation* seen = observation_of(builder, spec)) seen->lag_s = builder.effect_parameter(spec, index, "lag_s");
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  return one_a_sensor(machine, facts, "sensor_lag", "lag_s");
}

}  // namespace sensor_lag

extern const Effect sensor_lag_effect;
const Effect sensor_lag_effect = {"sensor_lag",
                                  "a sensor that answers late",
                                  "tau dy/dt = T - y",
                                  "sensors taped on, in pockets or housings: 20 to 600 s",
                                  "One channel is late in every transient and right when the temperature stands",
                                  "contact_resistance heater_body",
                                  {{"lag_s", 200.0, 0.0, 3000.0, true}},
                                  {"lag_s"},
                                  sensor_lag::add,
                                  sensor_lag::candidates,
                                  {},
                                  {.chord_share_of_run = 0.02}};

}  // namespace zerodrift::physics
