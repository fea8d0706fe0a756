#pragma once
// Whether a registration is a measurement of the target, by what it says of itself, and if not why.

#include "core/vision/target.h"

namespace zerodrift::vision {

struct Registration;

/// Of the coarse search: something like the target is in the frame. A glance takes a cover on a faint target for a part
/// of it; this gets the fine look too.
inline constexpr double alike_correlation = 0.5;
inline constexpr double least_inliers = 0.55;    // share of the pixels
inline constexpr double least_contrast = 0.2;    // of the template's
inline constexpr double largest_linear = 0.035;  // change of the affine part
inline constexpr double some_glare = 0.02;       // share of the pixels
inline constexpr double nothing_hidden = 0.97;   // share of the pixels that fit or are saturated

/// Refusal::none where it is one.
Refusal refusal_of(const Registration& found, double coarse_correlation);

}  // namespace zerodrift::vision
