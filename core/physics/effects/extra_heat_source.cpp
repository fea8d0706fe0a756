// A heat source that the description does not list: q law(n) at a place, spread over a fiftieth of the rod.
#include "core/physics/effects/laws.h"
#include "core/physics/sources.h"

namespace zerodrift::physics {
namespace extra_heat_source {

Law law(const std::string& form, int speed, double full_rpm) {
  return [=](const LawPoint& at) {
    Strength s;
    s.by_parameter[0] = speed_term(form, at.held[speed], full_rpm);
    s.value = at.values[0] * s.by_parameter[0];
    return s;
  };
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const std::vector<std::string> rods = builder.rods();
  const std::string id =
      spec.word_or("component", rods.empty() ? builder.machine().components.front().id : rods.front());
  const Component& component = *builder.machine().find(id);
  if (component.prescribed) return;
  const int power = builder.effect_parameter(spec, index, "power_W");
  Term source;
  if (component.lump) {
    source = builder.source_over(id, 0.0, 0.0);
  } else {
    const int place = builder.place_parameter(spec, index, component);
    source = builder.source_at(id, place, 0.02 * component.length_mm);
  }
  const std::string form = spec.word_or("law", "constant");
  source.label = id + "/extra_heat_source";
  source.parameters = {power};
  source.law_kind = form == "constant" ? LawKind::constant : LawKind::inputs;
  source.law = law(form, builder.held_speed(), builder.network().full_speed_rpm);
  builder.add_heat(id, std::move(source), builder.heat_share_of_effect(spec, index, id));
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  const double watts = std::max(5.0, 0.3 * facts.typical_heat_W);
  for (const auto& component : machine.components) {
    if (component.lump) continue;
    for (int i = 0; i < 10; ++i) {
      for (const char* form : {"constant", "on", "n", "n2"}) {
        if (std::string(form) != "constant" && !facts.has_speed) continue;
        list.push_back({"extra_heat_source",
                        true,
                        {{"power_W", 0.0},
                         {"power_W_prior_sigma", watts},
                         {"position_mm", (i + 0.5) / 10.0 * component.length_mm},
                         {"position_mm_prior_sigma", 0.06 * component.length_mm}},
                        {{"component", component.id}, {"law", form}}});
      }
    }
  }
  return list;
}

}  // namespace extra_heat_source

extern const Effect extra_heat_source_effect;
const Effect extra_heat_source_effect = {
    "extra_heat_source",
    "an extra heat source",
    "+q {1, on, n, n^2} at x",
    "seals, belts, pumps, hydraulics, neighbouring electronics: tens of watts",
    "One place is simulated too cold; the error is largest there and spreads both ways",
    "bearing_preload cutting_heat standing_heat",
    {{"power_W", 50.0, 0.0, 1e5, true}, {"position_mm", 20.0, 0.0, 30000.0}},
    {"power_W"},
    extra_heat_source::add,
    extra_heat_source::candidates,
    {},
    {.apart_share = 0.07}};

}  // namespace zerodrift::physics
