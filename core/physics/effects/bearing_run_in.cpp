// New or freshly greased bearings run heavier at first: friction times 1 + a exp(-t / tau).
#include "core/physics/effects/bearings.h"

namespace zerodrift::physics {
namespace bearing_run_in {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  BearingModifier m;
  m.kind = BearingModifier::Kind::run_in;
  m.parameter = builder.effect_parameter(spec, index, "excess_share");
  m.second_parameter = builder.effect_parameter(spec, index, "ln_decay_s", std::log(3600.0));
  modify_bearings(builder, spec, m);
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  if (!facts.has_speed || bearings_of(machine).empty() || machine.effect("bearing_run_in") != nullptr) return list;
  std::vector<std::string> where = bearings_of(machine);
  if (where.size() > 1) where.insert(where.begin(), "");
  for (const auto& bearing : where) {
    EffectSpec spec{"bearing_run_in", true, {{"excess_share", 0.0}, {"ln_decay_s", std::log(3600.0)}}, {}};
    if (!bearing.empty()) spec.words["bearing"] = bearing;
    list.push_back(spec);
  }
  return list;
}

}  // namespace bearing_run_in

extern const Effect bearing_run_in_effect;
const Effect bearing_run_in_effect = {
    "bearing_run_in",
    "bearings that run in",
    "heat times 1 + a exp(-t / tau)",
    "grease distribution in new bearings, hours to a day (maker's run-in instructions)",
    "Bearings are simulated too cold in the first hours only, whatever the temperature is later",
    "bearing_viscosity",
    {{"excess_share", 0.6, 0.0, 6.0, true}, {"ln_decay_s", 0.7, 6.0, 11.0, false, 8.2}},
    {"excess_share"},
    bearing_run_in::add,
    bearing_run_in::candidates,
    "spindle_rpm",
    {.log_rarity = -3.0, .once = true}};

}  // namespace zerodrift::physics
