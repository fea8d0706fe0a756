// An imperfect joint at x: the heat flow across it needs a temperature step R q. The resistance is spread evenly over
// the joint's breadth - shaft and housing do not part in one plane - and what lies between two cells' middles is shared
// by the faces next to it, so that x and the breadth are continuous. A cell's temperature is then its mean, part of the
// step within it included; a sensor reads the step's own share at its place and not what is straight between two cells.
#include "core/physics/effects/laws.h"
#include "core/physics/hat.h"

namespace zerodrift::physics {
namespace contact_resistance {

// Mostly two faces against each other, a plane; a fit is some millimetres long, seldom some tens.
constexpr double usual_half_width = 0.005;  // of the length
constexpr double widest = 0.05;             // wider, it would take the place of the rod beside it
constexpr double narrow_cells = 1e-3;       // of a cell: a plane

struct FaceShare {
  double value = 0.0;
  double by_place = 0.0;  // per cell
  double by_half = 0.0;
};

/// Share of a joint from u - half to u + half, in cells from the face.
FaceShare share_of_face(double u, double half) {
  if (half < narrow_cells) return {hat(u), hat(u) == 0.0 ? 0.0 : u > 0.0 ? -1.0 : 1.0, 0.0};
  FaceShare share;
  share.value = (hat_until(u + half) - hat_until(u - half)) / (2.0 * half);
  share.by_place = (hat(u + half) - hat(u - half)) / (2.0 * half);
  share.by_half = ((hat(u + half) + hat(u - half)) / 2.0 - share.value) / half;
  return share;
}

/// Change of one face's conductance k A / dx by the share of the joint that lies on it.
Law face_law(double face, double cell_m, double section_m2) {
  return [=](const LawPoint& at) {
    Strength s;
    const double by_mm = 1e-3 / cell_m;
    const FaceShare share = share_of_face(by_mm * at.values[1] - face, by_mm * at.values[3]);
    if (share.value == 0.0) return s;
    const double k = at.values[2];
    const double plain = k * section_m2 / cell_m;
    const double resistance = 1.0 / plain + share.value * at.values[0] / section_m2;
    const double conductance = 1.0 / resistance;
    const double by_share = -conductance * conductance * at.values[0] / section_m2;
    s.value = conductance - plain;
    s.by_parameter[0] = -conductance * conductance * share.value / section_m2;
    s.by_parameter[1] = by_share * share.by_place * by_mm;
    s.by_parameter[2] = (conductance * conductance / plain - plain) / k;
    s.by_parameter[3] = by_share * share.by_half * by_mm;
    return s;
  };
}

/// Of the step, what lies before y, in m from the fixed end, and its integral over y.
struct Passed {
  double share = 0.0, by_place = 0.0, by_half = 0.0;
  double sum = 0.0, sum_by_place = 0.0, sum_by_half = 0.0;
};

Passed passed_at(double y_m, double place_m, double half_m, double cell_m) {
  const double u = y_m - place_m;
  Passed p;
  if (half_m < narrow_cells * cell_m) {
    p.share = u > 0.0 ? 1.0 : u < 0.0 ? 0.0 : 0.5;
    p.sum = std::max(0.0, u);
    p.sum_by_place = -p.share;
    return p;
  }
  if (u <= -half_m) return p;
  p.share = std::min(1.0, 0.5 * (u + half_m) / half_m);
  p.sum_by_place = -p.share;
  if (u >= half_m) {
    p.sum = u;
    return p;
  }
  p.by_place = -0.5 / half_m;
  p.by_half = -0.5 * u / (half_m * half_m);
  p.sum = 0.25 * (u + half_m) * (u + half_m) / half_m;
  p.sum_by_half = 0.25 * (u + half_m) * (half_m - u) / (half_m * half_m);
  return p;
}

/// The step before a sensor, in shares of the whole, beside what its probe takes from the cells' means.
FaceShare beside_probe(const Probe& probe, int first, double sensor_m, double place_m, double half_m, double cell_m) {
  const Passed there = passed_at(sensor_m, place_m, half_m, cell_m);
  FaceShare beside{there.share, there.by_place, there.by_half};
  for (const auto& [node, weight] : probe) {
    const Passed from = passed_at((node - first) * cell_m, place_m, half_m, cell_m);
    const Passed to = passed_at((node - first + 1) * cell_m, place_m, half_m, cell_m);
    beside.value -= weight * (to.sum - from.sum) / cell_m;
    beside.by_place -= weight * (to.sum_by_place - from.sum_by_place) / cell_m;
    beside.by_half -= weight * (to.sum_by_half - from.sum_by_half) / cell_m;
  }
  return beside;
}

/// The step at a sensor is the resistance times the flow between the two cells it lies between, which is their
/// difference over what is between their middles.
Law step_law(const Probe& probe, int first, double sensor_m, double cell_m) {
  const int face = std::max(probe.front().first, probe.back().first) - first;
  return [=](const LawPoint& at) {
    Strength s;
    const double resistance = at.values[0];
    const double place_m = m_per_mm * at.values[1];
    const double k = at.values[2];
    const double half_m = m_per_mm * at.values[3];
    const FaceShare beside = beside_probe(probe, first, sensor_m, place_m, half_m, cell_m);
    const FaceShare between = share_of_face(place_m / cell_m - face, half_m / cell_m);
    if (beside.value == 0.0 && beside.by_place == 0.0 && beside.by_half == 0.0) return s;
    const double conductance = 1.0 / (cell_m / k + between.value * resistance);  // W/(m2 K)
    const double by_share = -resistance * resistance * conductance * conductance * beside.value;
    s.value = resistance * conductance * beside.value;
    s.by_parameter[0] = conductance * conductance * cell_m / k * beside.value;
    s.by_parameter[1] = m_per_mm * (resistance * conductance * beside.by_place + by_share * between.by_place / cell_m);
    s.by_parameter[2] = resistance * conductance * conductance * beside.value * cell_m / (k * k);
    s.by_parameter[3] = m_per_mm * (resistance * conductance * beside.by_half + by_share * between.by_half / cell_m);
    return s;
  };
}

/// Of a rod that conducts unevenly: the law of `at.values[2]`, a conductivity, times the last parameter.
Law uneven(Law even) {
  return [even = std::move(even)](const LawPoint& at) {
    constexpr std::size_t k = 2, share = 4;
    std::array<double, share> values{at.values[0], at.values[1], at.values[k] * at.values[share], at.values[3]};
    LawPoint there = at;
    there.values = values.data();
    Strength s = even(there);
    s.by_parameter[share] = s.by_parameter[k] * at.values[k];
    s.by_parameter[k] *= at.values[share];
    return s;
  };
}

/// Sensors read the outer cells.
void add_steps(NetworkBuilder& builder, const std::string& id, const std::vector<int>& parameters) {
  const auto at = builder.place(id);
  if (at.count < 2) return;
  for (const auto& sensor : builder.machine().sensors) {
    Observation* seen = builder.network().observation(sensor.channel);
    if (seen == nullptr || sensor.component != id) continue;
    const Probe probe = builder.probe_at(id, sensor.position_mm);
    const int last = std::max(probe.front().first, probe.back().first);
    StepTerm step;
    step.probe = builder.probe({{last, 1.0}, {last - 1, -1.0}});
    step.parameters = parameters;
    step.law = step_law(probe, at.first, m_per_mm * sensor.position_mm, at.cell_m);
    if (const int share = builder.conduction_share(id, last - at.first); share >= 0) {
      step.parameters.push_back(share);
      step.law = uneven(std::move(step.law));
    }
    seen->steps.push_back(std::move(step));
  }
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const std::vector<std::string> rods = builder.rods();
  if (rods.empty()) return;
  const std::string id = spec.word_or("component", rods.front());
  const Component& component = *builder.machine().find(id);
  const int resistance = builder.effect_parameter(spec, index, "resistance_m2K_W");
  const int place = builder.effect_parameter(spec, index, "position_mm", 0.5 * component.length_mm);
  Parameter& p = builder.network().parameters[place];
  p.low = 0.04 * component.length_mm;
  p.high = 0.96 * component.length_mm;
  const int half_width = builder.effect_parameter(spec, index, "half_width_mm", 0.0);
  builder.network().parameters[half_width].high = widest * component.length_mm;
  const auto at = builder.place(id);
  const auto add_joint = [&](int first, double section_share) {
    for (int face = 1; face < at.count; ++face) {
      Term term;
      term.kind = TermKind::link;
      term.law_kind = LawKind::constant;
      term.label = id + "/contact_resistance";
      term.links = {{first + face - 1, first + face, 1.0}};
      term.parameters = {resistance, place, builder.conductivity(id), half_width};
      term.law = face_law(face, at.cell_m, section_share * component.section_m2());
      if (const int share = builder.conduction_share(id, face); share >= 0) {
        term.parameters.push_back(share);
        term.law = uneven(std::move(term.law));
      }
      builder.add(std::move(term));
    }
  };
  add_joint(at.first, 1.0 - at.inner_share);
  if (at.inner >= 0) add_joint(at.inner, at.inner_share);
  add_steps(builder, id, {resistance, place, builder.conductivity(id), half_width});
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts&) {
  std::vector<EffectSpec> list;
  for (const auto& component : machine.components) {
    if (component.lump) continue;
    for (int i = 1; i <= 8; ++i) {
      list.push_back({"contact_resistance",
                      true,
                      {{"resistance_m2K_W", 0.0},
                       {"position_mm", i / 9.0 * component.length_mm},
                       {"position_mm_prior_sigma", 0.05 * component.length_mm},
                       {"half_width_mm", usual_half_width * component.length_mm}},
                      {{"component", component.id}}});
    }
  }
  return list;
}

}  // namespace contact_resistance

extern const Effect contact_resistance_effect;
const Effect contact_resistance_effect = {
    "contact_resistance",
    "a joint that conducts badly",
    "step R q of the temperature at x",
    "metal joints in air 0.5e-4 to 5e-3 m2 K/W (Yovanovich 2005)",
    "Opposite errors on the two sides of one place: the heated side too cold, the other too hot in the simulation",
    "sensor_lag extra_heat_source heater_body",
    {{"resistance_m2K_W", 4e-3, 0.0, 5e-2, true},
     {"position_mm", 20.0, 0.0, 30000.0},
     {"half_width_mm", 1.0, 0.0, 30000.0, false, 0.0, true}},
    {"resistance_m2K_W"},
    contact_resistance::add,
    contact_resistance::candidates,
    {},
    {.apart_share = 0.25}};

}  // namespace zerodrift::physics
