#pragma once
// A hypothesis: the machine as described, with a set of effects that were left out and of mistakes in the description
// set right. Its parameters are shared by all recordings, but for what is new in each (start, room, offsets, timing)
// and for effects that happen once, in one recording.

#include <memory>
#include <string>
#include <vector>

#include "core/diagnosis/description/description_error.h"
#include "core/physics/effects/effect.h"
#include "core/physics/machine.h"

namespace zerodrift::diagnosis::inference {

/// An effect of a hypothesis.
struct HeldEffect {
  physics::EffectSpec spec;  // candidate: its parameters have the effect's prior
  int run = -1;              // the recording in which it happens; -1: all
};

struct Hypothesis {
  physics::Machine machine;                   // described, with mistakes set right; its own effects alone
  std::vector<HeldEffect> effects;            // left out of it
  double log_prior = 0.0;                     // of all of them together
  std::vector<DescriptionError> errors = {};  // that were set right in `machine`

  /// What one recording saw.
  physics::Machine machine_in(int run) const;
  /// Index into `effects` of an effect of machine_in(run), -1: described.
  int effect_of(int run, int index) const;
};

}  // namespace zerodrift::diagnosis::inference
