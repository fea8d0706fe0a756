#include "core/diagnosis/inference/hypothesis.h"

namespace zerodrift::diagnosis::inference {

physics::Machine Hypothesis::machine_in(int run) const {
  physics::Machine there = machine;
  for (const HeldEffect& effect : effects) {
    if (effect.run < 0 || effect.run == run) there.effects.push_back(effect.spec);
  }
  return there;
}

int Hypothesis::effect_of(int run, int index) const {
  int at = static_cast<int>(machine.effects.size());
  if (index < at) return -1;
  for (std::size_t i = 0; i < effects.size(); ++i) {
    if (effects[i].run >= 0 && effects[i].run != run) continue;
    if (at++ == index) return static_cast<int>(i);
  }
  return -1;
}

}  // namespace zerodrift::diagnosis::inference
