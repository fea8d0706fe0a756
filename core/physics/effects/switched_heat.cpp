// Heat that comes and goes, or starts and stays, with nothing logged that switches it: a thermostat's heater, a pump, a
// neighbouring machine. Where a listed source is weaker than its log for a while, it is negative.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace switched_heat {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const Component* component = builder.machine().find(spec.word_or("component", ""));
  if (component == nullptr || component->prescribed || spec.intervals_s.empty()) return;
  const int power = builder.effect_parameter(spec, index, "power_W");
  const std::vector<int> edges = builder.interval_parameters(spec, index);
  Term source;
  if (component->lump) {
    source = builder.source_over(component->id, 0.0, 0.0);
  } else {
    source =
        builder.source_at(component->id, builder.place_parameter(spec, index, *component), 0.02 * component->length_mm);
  }
  source.label = component->id + "/switched_heat";
  add_in_intervals(builder, source, power, edges, edge_of(spec));
}

/// When it acted nobody knows: the stretches are proposed from what the recording leaves.
std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  if (facts.stretches_s.empty()) return list;
  const double hour_s = 3600.0;
  for (const auto& component : machine.components) {
    if (component.prescribed) continue;
    const double watts = component.lump ? component.heat_capacity_J_K.value_or(stand_in_capacity_J_K) * 20.0 / hour_s
                                        : std::max(5.0, 0.3 * facts.typical_heat_W);
    list.push_back({"switched_heat",
                    true,
                    {{"power_W", 0.0}, {"power_W_prior_sigma", watts}, {"edge_prior_sigma", 60.0}, {"edge_s", 60.0}},
                    {{"component", component.id}},
                    facts.stretches_s});
    if (!component.lump) list.back().numbers["position_mm"] = 0.5 * component.length_mm;
  }
  return list;
}

}  // namespace switched_heat

extern const Effect switched_heat_effect;
const Effect switched_heat_effect = {"switched_heat",
                                     "heat that something unlogged switches",
                                     "+q at x for t in [t1, t2], [t3, t4] ...",
                                     "thermostats, pumps, lamps, neighbouring machines: watts to kilowatts",
                                     "One part warms and cools in stretches of time that no logged input explains",
                                     "draught extra_heat_source",
                                     {{"power_W", 50.0, -1e5, 1e5, true}, {"position_mm", 20.0, 0.0, 30000.0}},
                                     {"power_W"},
                                     switched_heat::add,
                                     switched_heat::candidates,
                                     {},
                                     {.log_rarity = -3.0, .once = true, .event = Event::heat}};

}  // namespace zerodrift::physics
