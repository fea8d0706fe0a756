#pragma once
// Small laws that several effects share.

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
