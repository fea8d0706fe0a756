// Heat lost to the room over the outer surface: rho c A dT/dt = ... - h P (T - T_room). The published spindle model
// writes this term and then drops it. A lump of unknown surface has a conductance instead; with a room lag it feels the
// room late: tau dE/dt = T_room - E, -G (T - E).
#include <algorithm>
#include <cmath>

#include "core/physics/effects/laws.h"
#include "core/physics/initial_state.h"
#include "core/physics/unknown_sizes.h"

namespace zerodrift::physics {
namespace convection {

/// A film over an end of the rod; where it has two bodies, over both.
void add_end(NetworkBuilder& builder, const Component& component, bool far, Term term) {
  const auto at = builder.place(component.id);
  const int cell = far ? at.count - 1 : 0;
  term.kind = TermKind::film;
  term.environment = builder.room();
  term.first_node = at.first + cell;
  term.weights = {(1.0 - at.inner_share) * component.section_m2()};
  if (at.inner >= 0) {
    Term inside = term;
    inside.first_node = at.inner + cell;
    inside.weights = {at.inner_share * component.section_m2()};
    builder.add(std::move(inside));
  }
  builder.add(std::move(term));
}

bool turns(const Component& component) {
  return std::any_of(component.sources.begin(), component.sources.end(),
                     [](const HeatSource& source) { return source.kind == SourceKind::bearing; });
}

/// Where a film acts the ends lose heat too, and the nose of a spindle more when it turns, as (n / n_full)^0.7; how
/// much, the data say (0 unless the description knows it).
void add_end_loss(NetworkBuilder& builder, const Component& component, const EffectSpec& spec, int index) {
  Parameter h;
  h.key = "end_h_W_m2K";
  h.component = component.id;
  h.effect = index;
  h.low = 0.0;
  h.sigma = spec.candidate ? 10.0 : 0.7 * std::max(1.0, spec.number_or("h_W_m2K", 10.0));
  h.high = 8.0 * h.sigma;
  h.start = spec.number_or(h.key, 0.0);
  Term ends;
  ends.label = component.id + "/end";
  ends.law_kind = LawKind::constant;
  ends.law = proportional_law;
  ends.parameters = {builder.add_parameter(h)};
  add_end(builder, component, false, ends);
  add_end(builder, component, true, std::move(ends));
  if (!turns(component)) return;
  h.key = "nose_h_W_m2K";
  h.start = spec.number_or(h.key, 0.0);
  Term nose;
  nose.label = component.id + "/nose";
  nose.parameters = {builder.add_parameter(h)};
  nose.law = [speed = builder.held_speed(), full_rpm = builder.network().full_speed_rpm](const LawPoint& at) {
    Strength s;
    s.by_parameter[0] = std::pow(std::abs(at.held[speed]) / full_rpm, 0.7);
    s.value = at.values[0] * s.by_parameter[0];
    return s;
  };
  add_end(builder, component, true, std::move(nose));
}

Strength product_law(const LawPoint& at) {
  Strength s;
  s.value = at.values[0] * at.values[1];
  s.by_parameter[0] = at.values[1];
  s.by_parameter[1] = at.values[0];
  return s;
}

/// h (1 + t (x / L - 1/2)): one end sits in its seat, the other in moving air. How much, the data say.
void add_tilt(NetworkBuilder& builder, const Component& component, const EffectSpec& spec, int index, int strength) {
  Parameter tilt;
  tilt.key = "film_tilt";
  tilt.component = component.id;
  tilt.effect = index;
  tilt.sigma = 0.25;
  tilt.low = -1.5;
  tilt.high = 1.5;
  tilt.mean = spec.candidate ? 0.0 : spec.number_or(tilt.key, 0.0);
  tilt.start = tilt.mean;
  Term term = builder.film_over(component.id, 0.0, component.length_mm);
  const double cells = static_cast<double>(term.weights.size());
  for (std::size_t i = 0; i < term.weights.size(); ++i) term.weights[i] *= (static_cast<double>(i) + 0.5) / cells - 0.5;
  term.label = component.id + "/film_tilt";
  term.law_kind = LawKind::constant;
  term.environment = builder.room();
  term.parameters = {strength, builder.add_parameter(tilt)};
  term.law = product_law;
  builder.add(std::move(term));
}

/// The surface that the film acts on is identified with it: h A (T - T_room).
void film_of_unknown_area(NetworkBuilder& builder, const Component& component, Term& film) {
  Parameter area;
  area.key = "area_mm2";
  area.component = component.id;
  area.mean = area.start = *component.area_mm2;
  area.logarithmic = true;
  area.sigma = guess_width;
  for (double& weight : film.weights) weight /= *component.area_mm2;
  film.parameters.push_back(builder.add_parameter(area));
  film.law = product_law;
}

/// What stands between a part and the room - a cover, the machine around it - and is too large to be moved by the part.
int add_shell(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  constexpr double large_J_K = 1e6;
  const double room_C = first_value(builder.inputs(), builder.machine().room.channel);
  const int shell = builder.add_node(large_J_K, -1, std::isfinite(room_C) ? room_C : builder.mean_initial_C());
  Parameter start;
  start.key = "shell_start_K";
  start.component = spec.word_or("component", "");
  start.effect = index;
  start.sigma = 1.0;
  start.per_recording = true;
  builder.network().initial_parts.push_back({builder.add_parameter(start), {{shell, 1.0}}});
  Term film;
  film.kind = TermKind::film;
  film.law_kind = LawKind::constant;
  film.label = start.component + "/shell";
  film.first_node = shell;
  film.weights = {large_J_K};
  film.environment = builder.room();
  film.parameters = {builder.effect_parameter(spec, index, "room_lag_s", 7200.0)};
  film.law = [](const LawPoint& at) {
    Strength s;
    s.value = 1.0 / at.values[0];
    s.by_parameter[0] = -s.value * s.value;
    return s;
  };
  builder.add(std::move(film));
  return shell;
}

void add_late(NetworkBuilder& builder, const EffectSpec& spec, int index, int conductance) {
  for_components(builder, spec, [&](const Component& component) {
    if (!component.lump) return;
    Term link;
    link.kind = TermKind::link;
    link.law_kind = LawKind::constant;
    link.label = component.id + "/convection";
    link.links = {{builder.place(component.id).first, add_shell(builder, spec, index), 1.0}};
    link.parameters = {conductance};
    link.law = proportional_law;
    builder.add(std::move(link));
  });
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const bool by_conductance = spec.numbers.count("conductance_W_K") != 0;
  const int strength = builder.effect_parameter(spec, index, by_conductance ? "conductance_W_K" : "h_W_m2K");
  if (by_conductance && spec.numbers.count("room_lag_s") != 0) return add_late(builder, spec, index, strength);
  for_components(builder, spec, [&](const Component& component) {
    if (!by_conductance && !has_surface(component)) return;
    Term film = builder.film_over(component.id, 0.0, component.length_mm);
    if (by_conductance) film.weights.assign(film.weights.size(), 1.0 / static_cast<double>(film.weights.size()));
    film.label = component.id + "/convection";
    film.law_kind = LawKind::constant;
    film.environment = builder.room();
    film.parameters = {strength};
    film.law = proportional_law;
    if (!by_conductance && component.area_is_guessed) film_of_unknown_area(builder, component, film);
    builder.add(std::move(film));
    if (!component.lump) add_end_loss(builder, component, spec, index);
    if (component.inner) add_tilt(builder, component, spec, index, strength);
  });
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  bool surfaces = false;
  const bool all_described =
      machine.effect("convection") != nullptr && machine.effect("convection")->word_or("component", "").empty();
  for (const auto& component : machine.components) {
    if (component.prescribed) continue;
    if (has_surface(component)) {
      surfaces = true;
      continue;
    }
    bool described = false;
    for (const auto& spec : machine.effects) {
      described = described || (spec.id == "convection" && spec.word_or("component", "") == component.id);
    }
    if (described) continue;
    list.push_back({"convection", true, {{"conductance_W_K", 0.0}}, {{"component", component.id}}});
    if (!facts.room_logged || !component.lump) continue;
    list.push_back(
        {"convection", true, {{"conductance_W_K", 0.0}, {"room_lag_s", 7200.0}}, {{"component", component.id}}});
  }
  if (surfaces && !all_described) list.push_back({"convection", true, {{"h_W_m2K", 0.0}}, {}});
  return list;
}

}  // namespace convection

extern const Effect convection_effect;
const Effect convection_effect = {
    "convection",
    "convection to the room",
    "-h P (T - T_room) over the outer surface; a lump of unknown surface: -G (T - T_room), or late: -G (T - "
    "lag(T_room))",
    "Newton's law; VDI Heat Atlas F: 5 to 25 W/(m2 K) for free, up to 100 for forced air",
    "All temperatures are simulated too hot, more so the longer it runs; the measured cool-down is faster",
    "speed_convection radiation",
    {{"h_W_m2K", 25.0, 0.0, 300.0, true},
     {"conductance_W_K", 0.5, 0.0, 100.0, true},
     {"room_lag_s", 0.8, 300.0, 2e5, false, 0.0, true}},
    {"h_W_m2K", "conductance_W_K"},
    convection::add,
    convection::candidates};

}  // namespace zerodrift::physics
