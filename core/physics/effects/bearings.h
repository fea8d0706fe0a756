#pragma once
// Which bearings an effect acts on.

#include "core/physics/effects/laws.h"

namespace zerodrift::physics {

inline std::vector<std::string> bearings_of(const Machine& machine) {
  std::vector<std::string> ids;
  for (const auto& component : machine.components) {
    for (const auto& source : component.sources) {
      if (source.kind == SourceKind::bearing) ids.push_back(source.id);
    }
  }
  return ids;
}

/// On the bearing that the spec names, else on all.
inline void modify_bearings(NetworkBuilder& builder, const EffectSpec& spec, const BearingModifier& modifier) {
  const std::string only = spec.word_or("bearing", "");
  for (const auto& id : bearings_of(builder.machine())) {
    if (only.empty() || only == id) builder.modify_bearing(id, modifier);
  }
}

}  // namespace zerodrift::physics
