#pragma once
// Which pixels of a region belong to the target: not saturated, and travelling with it.

#include <cstdint>
#include <vector>

#include "core/vision/backdrop.h"
#include "core/vision/image.h"

namespace zerodrift::vision {

/// One byte a pixel of the region: 1 where the template is not saturated (a clipped edge has lost its place).
std::vector<std::uint8_t> usable_pixels(const GrayImage& image, const Region& region);

/// What a registered frame shows of a target's region.
struct ShownFrame {
  std::vector<float> residual_map;          // residual over its scale at each pixel, NaN where there is none
  std::vector<std::uint8_t> under_a_cover;  // one byte a pixel of the region; empty where that cannot be told
};

/// 1 where a frame shows neither the target nor what stood at that place of the picture when the template was taken:
/// something lies over it, in this frame. Empty where hardly anything of
/// the target fits.
std::vector<std::uint8_t> pixels_under_a_cover(const GrayImage& picture, const Region& region, const PixelPoint& point,
                                               const RegisteredFrame& frame, const std::vector<float>& residual_map);

/// One byte a pixel of the region: 1 where the registered frames agree with the template, 0 where they keep disagreeing
/// beyond the noise: what stands behind the target does not travel with it. What lies under a cover is not asked.
/// Empty when there are fewer than three frames.
std::vector<std::uint8_t> travelling_pixels(const Region& region, const std::vector<ShownFrame>& frames);

}  // namespace zerodrift::vision
