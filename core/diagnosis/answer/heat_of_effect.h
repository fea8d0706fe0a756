#pragma once
// An effect's size in watts, which a technician has a feeling for and which can be held against a catalogue: of a
// coolant the film coefficient says little.

#include <optional>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::answer {

/// Of the effect of that index in the hypothesis: the heat from outside with it less that without it, both at the
/// fitted temperatures, on average over the time in which it is a tenth of its largest at least. Its uncertainty is
/// the fit's, propagated to first order at those temperatures, which the sensors hold. Nothing for effects that bring
/// no heat, or none that the fit is sure of.
std::optional<EffectHeat> heat_of_effect(const inference::Fit& fit, std::size_t effect);

}  // namespace zerodrift::diagnosis::answer
