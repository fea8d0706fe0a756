#pragma once
// Round things that a picture shows: the rim of a ball, a disc.

#include <vector>

#include "core/vision/template_model.h"

namespace zerodrift::vision {

inline constexpr double least_radius_px = 12.0;

/// Circles that the template may show, likeliest first, those around the named point before the others; in the
/// coordinates of the source's pixels.
std::vector<RimCircle> circles_in(const TemplateSource& source);

/// The one that a picture shows within some pixels of where it is expected, to a few tenths; the expected one where
/// that has nearly as many edges; nothing where less than most of it is seen.
std::optional<RimCircle> circle_at(const FloatImage& picture, double noise, const RimCircle& expected);

/// Whether much within the circle changes from pixel to pixel; a ball shows smooth shades and some highlights.
bool shows_a_print(const TemplateSource& source, const RimCircle& circle);

}  // namespace zerodrift::vision
