#pragma once
// Small laws that several effects share.

#include <algorithm>
#include <cmath>

#include "core/physics/builder.h"

namespace zerodrift::physics {

/// Strength = parameter 0.
inline Strength proportional_law(const LawPoint& at) {
  Strength s;
  s.value = at.values[0];
  s.by_parameter[0] = 1.0;
  return s;
}

/// Strength = parameter 0 times a held input.
inline Law times_input(int input) {
  return [input](const LawPoint& at) {
    Strength s;
    s.by_parameter[0] = at.held[input];
    s.value = at.values[0] * s.by_parameter[0];
    return s;
  };
}

/// The most intervals that one term's law can have: a strength, and two edges each.
inline constexpr std::size_t most_intervals_of_a_term = (max_law_parameters - 1) / 2;

/// Strength = parameter 0 in the intervals [parameter 1, parameter 2], [3, 4] ... of recording time, with edges smooth
/// enough to be fitted.
inline Law in_intervals(std::size_t count, double edge_s) {
  return [count, edge_s](const LawPoint& at) {
    Strength s;
    double acts = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double rise = 0.5 * (1.0 + std::tanh((at.time_s - at.values[1 + 2 * i]) / edge_s));
      const double fall = 0.5 * (1.0 + std::tanh((at.time_s - at.values[2 + 2 * i]) / edge_s));
      acts += rise - fall;
      s.by_parameter[1 + 2 * i] = -at.values[0] * 2.0 * rise * (1.0 - rise) / edge_s;
      s.by_parameter[2 + 2 * i] = at.values[0] * 2.0 * fall * (1.0 - fall) / edge_s;
    }
    s.by_parameter[0] = acts;
    s.value = at.values[0] * acts;
    return s;
  };
}

/// Puts a term in for every few intervals, as many as one law can have; `term` without parameters and law.
inline void add_in_intervals(NetworkBuilder& builder, const Term& term, int strength, const std::vector<int>& edges,
                             double edge_s) {
  for (std::size_t first = 0; first < edges.size(); first += 2 * most_intervals_of_a_term) {
    const std::size_t last = std::min(edges.size(), first + 2 * most_intervals_of_a_term);
    Term one = term;
    one.law_kind = LawKind::time;
    one.parameters = {strength};
    one.parameters.insert(one.parameters.end(), edges.begin() + static_cast<std::ptrdiff_t>(first),
                          edges.begin() + static_cast<std::ptrdiff_t>(last));
    one.law = in_intervals((last - first) / 2, edge_s);
    builder.add(std::move(one));
  }
}

/// How long an effect takes to come and to go, s.
inline double edge_of(const EffectSpec& spec) {
  return spec.number_or("edge_s", 5.0);
}

/// Calls `act` for each component that the spec means: the one it names, else all that are not prescribed.
template <class Act>
void for_components(const NetworkBuilder& builder, const EffectSpec& spec, Act act) {
  const std::string only = spec.word_or("component", "");
  for (const auto& component : builder.machine().components) {
    if (!component.prescribed && (only.empty() || only == component.id)) act(component);
  }
}

/// Surface towards the room is known.
inline bool has_surface(const Component& component) {
  return !component.lump || component.area_mm2.has_value();
}

}  // namespace zerodrift::physics
