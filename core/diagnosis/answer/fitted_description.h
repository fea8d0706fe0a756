#pragma once
// From a fit to a machine description: the shared numbers as fitted, the effects with theirs, so that a simulation of
// the description gives what was reported. What is new in each recording - starts, offsets - is no part of it.

#include <map>
#include <string>

#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::answer {

/// Effects that happened once, and a room that nobody logged, are in it as recording `run` has them; -1: none.
physics::Machine fitted_description(const inference::Fit& fit, int run = 0);
/// A number of the description takes this value; what the description has no number for stays as it is.
void take_value(physics::Machine& machine, const physics::Parameter& parameter, double value);
/// One effect's numbers and intervals after the fit; standard deviations by key.
physics::EffectSpec fitted_effect(const inference::Fit& fit, std::size_t effect,
                                  std::map<std::string, double>* sigma = nullptr);

}  // namespace zerodrift::diagnosis::answer
