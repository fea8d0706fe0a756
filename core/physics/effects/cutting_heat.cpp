// A share of the spindle load enters at the nose: eta load over the last 3 % of the rod.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace cutting_heat {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const std::vector<std::string> rods = builder.rods();
  if (rods.empty()) return;
  const std::string id = spec.word_or("component", rods.front());
  const double length_mm = builder.machine().find(id)->length_mm;
  Term source = builder.source_over(id, 0.97 * length_mm, length_mm);
  source.label = id + "/cutting_heat";
  source.parameters = {builder.effect_parameter(spec, index, "share")};
  source.law = times_input(builder.held("spindle_load_W"));
  builder.add_heat(id, std::move(source), builder.heat_share_of_effect(spec, index, id));
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  if (!facts.has_load || machine.effect("cutting_heat") != nullptr) return list;
  for (const auto& component : machine.components) {
    if (!component.lump) list.push_back({"cutting_heat", true, {{"share", 0.0}}, {{"component", component.id}}});
  }
  return list;
}

}  // namespace cutting_heat

extern const Effect cutting_heat_effect;
const Effect cutting_heat_effect = {
    "cutting_heat",
    "heat of cutting at the nose",
    "+eta load over the last 0.03 L",
    "share of the cutting power that enters the tool, 2 to 20 % (Trent and Wright, Metal Cutting)",
    "The nose is simulated too cold while the machine cuts",
    "extra_heat_source",
    {{"share", 0.05, 0.0, 1.0, true}},
    {"share"},
    cutting_heat::add,
    cutting_heat::candidates,
    "spindle_load_W"};

}  // namespace zerodrift::physics
