// Two components that the description keeps apart exchange heat: G (T_other - T). A rod and a part whose temperature is
// measured touch anywhere along the rod; other parts are joined in the middle, unless the description says where.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace neighbour_heat {

constexpr double breadth = 0.03;  // of the length: a bracket, a flange
constexpr int places = 8;

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const Component* one = builder.machine().find(spec.word_or("component", ""));
  const Component* other = builder.machine().find(spec.word_or("neighbour", ""));
  if (one == nullptr || other == nullptr || one->prescribed) return;
  const int conductance = builder.effect_parameter(spec, index, "conductance_W_K");
  Term term;
  if (other->prescribed) {
    const int place = one->lump ? -1 : builder.place_parameter(spec, index, *one);
    term = builder.source_at(one->id, place, breadth * one->length_mm);
  }
  term.label = one->id + "-" + other->id + "/neighbour_heat";
  term.law_kind = LawKind::constant;
  term.parameters = {conductance};
  term.law = proportional_law;
  if (other->prescribed) {
    for (std::size_t e = 0; e < builder.network().environments.size(); ++e) {
      if (builder.network().environments[e].name == other->id) term.environment = static_cast<int>(e);
    }
    term.kind = TermKind::film;
  } else {
    term.kind = TermKind::link;
    const Probe here = builder.probe_at(one->id, spec.number_or("position_mm", 0.5 * one->length_mm));
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
      const int count = other->prescribed && !one->lump ? places : 1;
      for (int at = 0; at < count; ++at) {
        list.push_back(spec);
        if (count == 1) continue;
        list.back().numbers["position_mm"] = (at + 0.5) / count * one->length_mm;
        list.back().numbers["position_mm_prior_sigma"] = 0.5 / count * one->length_mm;
      }
    }
  }
  return list;
}

}  // namespace neighbour_heat

extern const Effect neighbour_heat_effect;
const Effect neighbour_heat_effect = {"neighbour_heat",
                                      "heat from a neighbouring part",
                                      "G (T_other - T)",
                                      "bolted or neighbouring parts, shared boards: 0.01 to 10 W/K",
                                      "A part without a source of its own warms after its neighbour does",
                                      "extra_heat_source room_sensor_fault",
                                      {{"conductance_W_K", 2.0, 0.0, 500.0, true}, {"position_mm", 20.0, 0.0, 30000.0}},
                                      {"conductance_W_K"},
                                      neighbour_heat::add,
                                      neighbour_heat::candidates};

}  // namespace zerodrift::physics
