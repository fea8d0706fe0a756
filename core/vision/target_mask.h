#pragma once
// Which pixels of a region belong to the target: not saturated, and travelling with it.

#include <cstdint>
#include <vector>

#include "core/vision/image.h"

namespace zerodrift::vision {

/// One byte a pixel of the region: 1 where the template is not saturated (a clipped edge has lost its place).
std::vector<std::uint8_t> usable_pixels(const GrayImage& image, const Region& region);

/// One byte a pixel of the region: 1 where the registered frames agree with the template, 0 where they keep disagreeing
/// beyond the noise: what stands behind the target does not travel with it. Each map has the residual over its scale at
/// each pixel, NaN where there is none. Empty when there are fewer than three maps.
std::vector<std::uint8_t> travelling_pixels(const Region& region, const std::vector<std::vector<float>>& residual_maps);

}  // namespace zerodrift::vision
