#pragma once
// The effects that a hypothesis could be extended by: every form of every effect that this machine and these recordings
// allow, each with its prior.

#include <vector>

#include "core/diagnosis/inference/hypothesis.h"
#include "core/physics/effects/effect.h"

namespace zerodrift::diagnosis::search {

struct Candidate {
  inference::HeldEffect effect;
  double log_prior = 0.0;  // of the kind, and of this form among its forms
};

/// What cannot be there without another effect is not offered before that one is in the model.
bool lacks_required(const physics::Machine& machine, const physics::EffectSpec& spec);

/// `facts`: of each recording.
std::vector<Candidate> candidates_for(const inference::Hypothesis& hypothesis,
                                      const std::vector<physics::RunFacts>& facts, double effect_log_prior);

}  // namespace zerodrift::diagnosis::search
