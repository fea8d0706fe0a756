#pragma once
// What a description leaves out of a lump: its heat capacity, or the surface that a described film acts on.

#include "core/physics/machine.h"

namespace zerodrift::physics {

/// One sigma of a guess, natural logarithm: a factor of four and a half either way.
inline constexpr double guess_width = 1.5;

/// Gives each lump without a heat capacity, and each without a surface under a described film, a first guess that is
/// marked as one: the fit then identifies it as far as the recording can tell. Where nothing in the description says
/// how large anything is - no rod, no capacity, no watts, no W/K - only ratios can be found, and all stays unknown.
void guess_unknown_sizes(Machine& machine);

}  // namespace zerodrift::physics
