#pragma once
// A hypothesis with a mistake set right, and the value of it - a place, a length, a factor - where the data want it:
// the value is one more unknown of the linear model, its derivative a difference of two simulations.

#include <memory>

#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::description {

/// `described`: with all mistakes.
inference::Hypothesis with_error(const physics::Machine& described, inference::Hypothesis hypothesis,
                                 DescriptionError error);

/// A hypothesis that has one mistake more than `parent`, started there; few steps, its value among them.
std::shared_ptr<inference::Fit> fitted_with(const inference::Fit& parent, const DescriptionError& error);

/// An error of a fit's hypothesis as it was fitted: of a number, the factor and its standard deviation.
DescriptionError fitted_error(const inference::Fit& fit, std::size_t error);

}  // namespace zerodrift::diagnosis::description
