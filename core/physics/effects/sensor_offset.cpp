// One sensor reads wrong by a constant beyond its accuracy.
#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace sensor_offset {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  Observation* seen = observation_of(builder, spec);
  if (seen == nullptr) return;
  StructureTerm constant;
  constant.gain = builder.effect_parameter(spec, index, "offset_K");
  constant.signal =
      builder.signal({"one", [intervals = spec.intervals_s](const double*, const double*, double time_s) {
                        return intervals.empty() || std::any_of(intervals.begin(), intervals.end(),
                                                                [&](const auto& one) {
                                                                  return one.first <= time_s && time_s < one.second;
                                                                })
                                   ? 1.0
                                   : 0.0;
                      }});
  seen->structure.push_back(constant);
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  auto list = one_a_sensor(machine, facts, "sensor_offset", "offset_K");
  for (auto& spec : list) {
    const double accuracy_C = machine.sensor(spec.words["channel"])->accuracy_C;
    spec.numbers["offset_K_prior_sigma"] = std::max(1.2, 3.0 * accuracy_C);
  }
  return list;
}

}  // namespace sensor_offset

extern const Effect sensor_offset_effect;
const Effect sensor_offset_effect = {"sensor_offset",
                                     "a sensor that reads wrong by a constant",
                                     "y = T + b",
                                     "wiring, calibration or contact faults: beyond the stated accuracy",
                                     "One channel differs by a constant from the first sample on",
                                     "contact_resistance",
                                     {{"offset_K", 1.2, -20.0, 20.0, true}},
                                     {"offset_K"},
                                     sensor_offset::add,
                                     sensor_offset::candidates,
                                     {},
                                     {.event = Event::reading}};

}  // namespace zerodrift::physics
