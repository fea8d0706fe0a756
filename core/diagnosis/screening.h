#pragma once
// Which effects could explain what the fitted base leaves: every form of every effect gets one efficient score test
// (Rao 1948) around the base fit. All are derivatives of one simulation, so a hundred forms cost little more than one.

#include <memory>
#include <span>
#include <vector>

#include "core/diagnosis/model.h"
#include "core/physics/effects/effect.h"

namespace zerodrift::diagnosis {

struct Candidate {
  physics::EffectSpec spec;
  double gain = 0.0;         // cost that one step would save
  double detectable = 0.0;   // amplitude that would have shown (5 sigma), in the amplitude's unit
  std::vector<double> step;  // standardised amplitudes after that step, in the order of the effect's amplitudes
  double usual = 0.0;        // width of what there usually is of it, in the same unit
};

/// Two effects that hide each other: heat that one adds the other takes away, and each shows only beside the other.
struct HiddenPair {
  std::vector<Candidate> effects;  // two, or none
  double gain = 0.0;               // of both together
};

physics::RunFacts facts_of(const physics::Machine& machine, const recording::Recording& recording);
/// Best first. Forms that the model already has are left out. `pair`: filled with the two that gain most together of
/// those that gain more by `least` than each alone in sum.
std::vector<Candidate> screen(const Model& base, const physics::RunFacts& facts, HiddenPair* pair = nullptr,
                              double least = 0.0);
/// Two joints so close that the second only mends the shape of the first: places move while they are fitted.
bool doubles_a_joint(const Model& model);
/// The last effect is a heat, or the fault of a sensor, so close to a joint that it may only mend the joint's shape,
/// which is hardly known.
bool mends_a_joint(const Model& model);
/// The model with one candidate more, or several, started at the candidates' steps, not yet fitted.
std::shared_ptr<Model> extended(const Model& base, const Candidate& candidate);
std::shared_ptr<Model> extended(const Model& base, std::span<const Candidate> candidates);
/// The model without its effect at `index`, not yet fitted.
std::shared_ptr<Model> reduced(const Model& model, std::size_t index);

}  // namespace zerodrift::diagnosis
