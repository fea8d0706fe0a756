// A chiller on its own thermostat removes heat in a rhythm that no logged input shows:
// q(t) = -m + a sin(2 pi t / P) + b cos(2 pi t / P) over a region.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace chiller_cycle {

Strength law(const LawPoint& at) {
  const double phase = 2.0 * 3.14159265358979 * at.time_s / at.values[2];
  Strength s;
  s.by_parameter[0] = std::sin(phase);
  s.by_parameter[1] = std::cos(phase);
  s.by_parameter[2] = -(at.values[0] * std::cos(phase) - at.values[1] * std::sin(phase)) * phase / at.values[2];
  s.by_parameter[3] = -1.0;
  s.value = at.values[0] * s.by_parameter[0] + at.values[1] * s.by_parameter[1] - at.values[3];
  return s;
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const std::vector<std::string> rods = builder.rods();
  if (rods.empty()) return;
  const std::string id = spec.word_or("component", rods.front());
  const Component& component = *builder.machine().find(id);
  Term source = builder.source_over(id, spec.number_or("from_mm", 0.0), spec.number_or("to_mm", component.length_mm));
  source.label = id + "/chiller_cycle";
  source.law_kind = LawKind::time;
  source.parameters = {
      builder.effect_parameter(spec, index, "sine_W"), builder.effect_parameter(spec, index, "cosine_W"),
      builder.effect_parameter(spec, index, "period_s", 1800.0), builder.effect_parameter(spec, index, "mean_W")};
  source.law = law;
  builder.add(std::move(source));
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  constexpr double fewest_periods = 3.0;  // one or two are like any slow wave
  const double watts = std::max(5.0, 0.3 * facts.typical_heat_W);
  for (const auto& component : machine.components) {
    if (component.lump) continue;
    for (const auto& source : component.sources) {
      if (source.kind != SourceKind::motor) continue;
      for (const double period_s : {900.0, 1300.0, 1800.0, 2500.0, 3600.0}) {
        if (facts.duration_s < fewest_periods * period_s) continue;
        list.push_back({"chiller_cycle",
                        true,
                        {{"sine_W", 0.0},
                         {"cosine_W", 0.0},
                         {"mean_W", 0.0},
                         {"sine_W_prior_sigma", watts},
                         {"cosine_W_prior_sigma", watts},
                         {"mean_W_prior_sigma", watts},
                         {"period_s", period_s},
                         {"period_s_prior_sigma", 0.12 * period_s},
                         {"from_mm", source.from_mm},
                         {"to_mm", source.to_mm}},
                        {{"component", component.id}}});
      }
    }
  }
  return list;
}

}  // namespace chiller_cycle

extern const Effect chiller_cycle_effect;
const Effect chiller_cycle_effect = {"chiller_cycle",
                                     "a chiller that switches on its own",
                                     "q = -m + a sin(2 pi t / P) + b cos(2 pi t / P)",
                                     "two-point controlled chillers: periods of 10 to 60 min",
                                     "Temperatures saw with a period of their own that no logged input has",
                                     "coolant",
                                     {{"sine_W", 20.0, -5000.0, 5000.0, true},
                                      {"cosine_W", 20.0, -5000.0, 5000.0, true},
                                      {"period_s", 200.0, 300.0, 20000.0},
                                      {"mean_W", 20.0, 0.0, 5000.0, true}},
                                     {"sine_W"},
                                     chiller_cycle::add,
                                     chiller_cycle::candidates,
                                     {},
                                     {.log_rarity = -3.0}};

}  // namespace zerodrift::physics
