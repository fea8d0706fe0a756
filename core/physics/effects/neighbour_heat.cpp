// Two components that the description keeps apart exchange heat: G (T_other - T).
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace neighbour_heat {

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const Component* one = builder.machine().find(spec.word_or("component", ""));
  const Component* other = builder.machine().find(spec.word_or("neighbour", ""));
  if (one == nullptr || other == nullptr || one->prescribed) return;
  const int conductance = builder.effect_parameter(spec, index, "conductance_W_K");
  Term term;
  term.label = one->id + "-" + other->id + "/neighbour_heat";
  term.law_kind = LawKind::constant;
  term.parameters = {conductance};
  term.law = proportional_law;
  const Probe here = builder.probe_at(one->id, spec.number_or("position_mm", 0.5 * one->length_mm));
  if (other->prescribed) {
    for (std::size_t e = 0; e < builder.network().environments.size(); ++e) {
      if (builder.network().environments[e].name == other->id) term.environment = static_cast<int>(e);
    }
    term.kind = TermKind::film;
    term.first_node = here.front().first;
    term.weights = {1.0};
  } else {
    term.kind = TermKind::link;
    const Probe there = builder.probe_at(other->id, spec.number_or("neighbour_mm", 0.5 * other->length_mm));
    for (const auto& [a, wa] : here) {
      for (const auto& [b, wb] : there) {
        if (wa * wb > 0.0) term.links.push_back({a, b, wa * wb});
      }
    }
  }
  builder.add(std::move(term));
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  std::vector<EffectSpec> list;
  if (machine.components.size() > 6) return list;
  const auto joined = [&](const std::string& a, const std::string& b) {
    for (const auto& coupling : machine.couplings) {
      const auto& f = coupling.first.component;
      const auto& s = coupling.second.component;
      if ((f == a && s == b) || (f == b && s == a)) return true;
    }
    return false;
  };
  for (std::size_t i = 0; i < machine.components.size(); ++i) {
    for (std::size_t k = i + 1; k < machine.components.size(); ++k) {
      const Component* one = &machine.components[i];
      const Component* other = &machine.components[k];
      if (one->prescribed) std::swap(one, other);
      if (one->prescribed || joined(one->id, other->id)) continue;
      EffectSpec spec{
          "neighbour_heat", true, {{"conductance_W_K", 0.0}}, {{"component", one->id}, {"neighbour", other->id}}};
      // Against the size of what it couples: a few of the smaller part's film conductances.
      const double area_m2 = 1e-6 * std::min(one->area_mm2.value_or(1e5), other->area_mm2.value_or(1e5));
      spec.numbers["conductance_W_K_prior_sigma"] = 25.0 * area_m2;
      list.push_back(spec);
    }
  }
  return list;
}

}  // namespace neighbour_heat

extern const Effect neighbour_heat_effect;
const Effect neighbour_heat_effect = {"neighbour_heat",
                                      "G (T_other - T)",
                                      "bolted or neighbouring parts, shared boards: 0.01 to 10 W/K",
                                      "A part without a source of its own warms after its neighbour does",
                                      "extra_heat_source room_sensor_fault",
                                      {{"conductance_W_K", 2.0, 0.0, 500.0, true}},
                                      {"conductance_W_K"},
                                      neighbour_heat::add,
                                      neighbour_heat::candidates};

}  // namespace zerodrift::physics
