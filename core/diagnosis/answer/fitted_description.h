#pragma once
// From a fit to a machine description: the shared numbers as fitted, the effects with theirs, so that a simulation of
// the description gives what was reported. What is new in each recording - starts, offsets - is no part of it.

#include <map>
#include <string>

#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::answer {

/// Effects that happened once are in it where they happened in recording `run`.
physics::Machine fitted_description(const inference::Fit& fit, int run = 0);
/// One effect's numbers and intervals after the fit; standard deviations by key.
physics::EffectSpec fitted_effect(const inference::Fit& fit, std::size_t effect,
                                  std::map<std::string, double>* sigma = nullptr);

}  // namespace zerodrift::diagnosis::answer
