// The structure follows the room and moves the nose: d += g lag(T_room - T0, tau). Driven by "nothing" it is never
// named: a displacement that settles by itself, d += sum of s_i exp(-t / tau_i), or drifts, d += v t, is the rival that
// whatever says to follow the room has to beat. What creeps has such a spectrum of times; a probe drifts.
#include <array>

#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace structure_ambient {

struct Settling {
  const char* key;
  double time_s;
};
constexpr std::array<Settling, 3> spectrum = {
    {{"um_in_1200_s", 1200.0}, {"um_in_4800_s", 4800.0}, {"um_in_19200_s", 19200.0}}};

constexpr const char* drift_key = "um_per_h";

void add_by_itself(NetworkBuilder& builder, const EffectSpec& spec, int index, Observation& seen) {
  const std::vector<double>& times_s = builder.inputs().time_s;
  const double start_s = times_s.empty() ? 0.0 : times_s.front();
  if (spec.numbers.count(drift_key) != 0) {
    StructureTerm term;
    term.gain = builder.effect_parameter(spec, index, drift_key);
    term.signal = builder.signal(
        {"drift", [start_s](const double*, const double*, double time_s) { return (time_s - start_s) / 3600.0; }});
    seen.structure.push_back(term);
    return;
  }
  for (const Settling& part : spectrum) {
    StructureTerm term;
    term.gain = builder.effect_parameter(spec, index, part.key);
    term.signal =
        builder.signal({"settling", [start_s, tau_s = part.time_s](const double*, const double*, double time_s) {
                          return std::exp(-(time_s - start_s) / tau_s);
                        }});
    seen.structure.push_back(term);
  }
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  Observation* seen = observation_of(builder, spec);
  if (seen == nullptr) return;
  if (spec.word_or("driver", "") == "nothing") return add_by_itself(builder, spec, index, *seen);
  StructureTerm term;
  term.gain = builder.effect_parameter(spec, index, "um_per_K");
  term.lag = builder.effect_parameter(spec, index, "lag_s", 4000.0);
  term.initial = unknown_start(builder, spec, index);
  term.signal = room_rise_signal(builder);
  seen->structure.push_back(term);
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  if (!facts.room_logged) return list;
  for (const auto& displacement : machine.displacements) {
    if (displacement.component.empty()) continue;
    // Several starts: the error over tau has more than one valley.
    for (const double lag_s : {1200.0, 4000.0, 12000.0}) {
      list.push_back(
          {"structure_ambient", true, {{"um_per_K", 0.0}, {"lag_s", lag_s}}, {{"channel", displacement.channel}}});
    }
  }
  return list;
}

}  // namespace structure_ambient

EffectSpec settling_by_itself(const std::string& channel) {
  EffectSpec spec{"structure_ambient", true, {}, {{"channel", channel}, {"driver", "nothing"}}};
  for (const auto& part : structure_ambient::spectrum) spec.numbers[part.key] = 0.0;
  return spec;
}

EffectSpec drifting_by_itself(const std::string& channel) {
  return {
      "structure_ambient", true, {{structure_ambient::drift_key, 0.0}}, {{"channel", channel}, {"driver", "nothing"}}};
}

extern const Effect structure_ambient_effect;
const Effect structure_ambient_effect = {"structure_ambient",
                                         "d += g lag(T_room - T0, tau)",
                                         "column and bed follow the room with 1 to 10 h (ISO 230-3 ETVE)",
                                         "Only displacements are off; they follow the room with a delay",
                                         "structure_bending",
                                         {{"um_per_K", 5.0, -60.0, 60.0, true},
                                          {"lag_s", 0.7, 200.0, 40000.0, false, 4000.0, true},
                                          {"um_per_h", 0.5, -50.0, 50.0, true},
                                          {"um_in_1200_s", 5.0, -500.0, 500.0, true},
                                          {"um_in_4800_s", 5.0, -500.0, 500.0, true},
                                          {"um_in_19200_s", 5.0, -500.0, 500.0, true}},
                                         {"um_per_K"},
                                         structure_ambient::add,
                                         structure_ambient::candidates};

}  // namespace zerodrift::physics
