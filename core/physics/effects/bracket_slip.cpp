// A bracket or probe slips: a step in one displacement at one moment.
#include "core/physics/effects/sensor_effects.h"

namespace zerodrift::physics {
namespace bracket_slip {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  Observation* seen = observation_of(builder, spec);
  if (seen == nullptr) return;
  StructureTerm step;
  step.gain = builder.effect_parameter(spec, index, "step_um");
  const double at_s = spec.number_or("time_s", 0.0);
  step.signal =
      builder.signal({"step", [=](const double*, const double*, double time_s) { return time_s >= at_s ? 1.0 : 0.0; }});
  seen->structure.push_back(step);
}

std::vector<EffectSpec> candidates(const Machine&, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  for (const auto& [channel, times_s] : facts.jump_times_s) {
    for (const double at_s : times_s) {
      list.push_back({"bracket_slip", true, {{"step_um", 0.0}, {"time_s", at_s}}, {{"channel", channel}}});
    }
  }
  return list;
}

}  // namespace bracket_slip

extern const Effect bracket_slip_effect;
const Effect bracket_slip_effect = {
    "bracket_slip",
    "a bracket that slipped",
    "d += s for t >= t_s",
    "clamped probe holders and loose joints: single steps of micrometres",
    "One displacement jumps between two samples and stays there; no temperature moves. A gauge that was set to "
    "zero again and a probe that was touched look the same",
    "structure_driver",
    {{"step_um", 5.0, -500.0, 500.0, true}},
    {"step_um"},
    bracket_slip::add,
    bracket_slip::candidates,
    {},
    {.log_rarity = -3.0, .once = true}};

}  // namespace zerodrift::physics
