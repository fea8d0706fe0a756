#pragma once
// What the effects on single channels share.

#include "core/physics/effects/laws.h"

namespace zerodrift::physics {

inline Observation* observation_of(NetworkBuilder& builder, const EffectSpec& spec) {
  return builder.network().observation(spec.word_or("channel", ""));
}

/// One candidate a measured sensor on a component.
inline std::vector<EffectSpec> one_a_sensor(const Machine& machine, const RunFacts& facts, const std::string& id,
                                            const std::string& key) {
  std::vector<EffectSpec> list;
  for (const auto& sensor : machine.sensors) {
    const Component* component = machine.find(sensor.component);
    const bool there = std::find(facts.channels.begin(), facts.channels.end(), sensor.channel) != facts.channels.end();
    if (component == nullptr || component->prescribed || !there) continue;
    list.push_back({id, true, {{key, 0.0}}, {{"channel", sensor.channel}}});
  }
  return list;
}

/// A signal: room temperature less the start temperature, or less another.
inline int room_rise_signal(NetworkBuilder& builder, std::optional<double> from_C = std::nullopt) {
  const Environment& room = builder.network().environments[builder.room()];
  const int series = room.series;
  const double start_C = from_C.value_or(builder.mean_initial_C());
  return builder.signal({"room_rise", [=](const double*, const double* linear, double) {
                           return series >= 0 ? linear[series] - start_C : 0.0;
                         }});
}

/// The structure need not have been in balance with the room when the recording began.
inline int unknown_start(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  Parameter start;
  start.key = "start_K";
  start.channel = spec.word_or("channel", "");
  start.effect = index;
  start.sigma = 0.4;
  start.per_recording = true;
  return builder.add_parameter(start);
}

}  // namespace zerodrift::physics
