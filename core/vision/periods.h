#pragma once
// Shifts by which a pattern looks like itself: grids of dots, checkers, rows of lines. Whoever sees only a part of such
// a target cannot tell one period from the next.

#include <array>
#include <vector>

#include "core/vision/image.h"

namespace zerodrift::vision {

/// Peaks of the normalized correlation of the region with itself over their overlap, in px, each with its opposite; the
/// most alike first, to about 2 px. Empty for a pattern that is like itself nowhere.
std::vector<std::array<int, 2>> periods_of(const GrayImage& image, const Region& region);

}  // namespace zerodrift::vision
