// The structure follows the room and moves the nose: d += g lag(T_room - T0, tau).
#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace structure_ambient {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  Observation* seen = observation_of(builder, spec);
  if (seen == nullptr) return;
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

extern const Effect structure_ambient_effect;
const Effect structure_ambient_effect = {
    "structure_ambient",
    "the structure following the room",
    "d += g lag(T_room - T0, tau)",
    "column and bed follow the room with 1 to 10 h (ISO 230-3 ETVE)",
    "Only displacements are off; they follow the room with a delay",
    "structure_bending",
    {{"um_per_K", 5.0, -60.0, 60.0, true}, {"lag_s", 0.7, 200.0, 40000.0, false, 4000.0, true}},
    {"um_per_K"},
    structure_ambient::add,
    structure_ambient::candidates,
    "ambient_C"};

}  // namespace zerodrift::physics
