#include <stdexcept>

#include "core/physics/effects/effect.h"

namespace zerodrift::physics {

extern const Effect convection_effect;

const std::vector<const Effect*>& all_effects() {
  static const std::vector<const Effect*> effects = {
      &convection_effect,
  };
  return effects;
}

const Effect* find_effect(std::string_view id) {
  for (const Effect* effect : all_effects()) {
    if (effect->id == id) return effect;
  }
  return nullptr;
}

std::string effect_ids() {
  std::string list;
  for (const Effect* effect : all_effects()) list += (list.empty() ? "" : ", ") + std::string(effect->id);
  return list;
}

const EffectParameter& Effect::parameter(std::string_view key) const {
  for (const auto& one : parameters) {
    if (one.key == key) return one;
  }
  throw std::logic_error("effect " + std::string(id) + " has no parameter " + std::string(key));
}

}  // namespace zerodrift::physics
