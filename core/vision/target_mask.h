#pragma once
// Which pixels of a region belong to the target: not saturated, and travelling with it.

#include <cstdint>
#include <vector>

#include "core/vision/image.h"

namespace zerodrift::vision {

/// One byte a pixel of the region: 1 where the template is not saturated (a clipped edge has lost its place).
std::vector<std::uint8_t> usable_pixels(const GrayImage& image, const Region& region);

struct MovedFrame {
  const GrayImage* frame = nullptr;
  double x_px = 0.0;  // displacement of the target since the template
  double y_px = 0.0;
};

/// One byte a pixel of the region: 1 where the frames, moved back, agree with the template; what stands still behind
/// the target does not. Empty when the frames (three or more, moved by over two pixels) cannot tell.
std::vector<std::uint8_t> travelling_pixels(const GrayImage& image, const Region& region,
                                            const std::vector<MovedFrame>& frames);

}  // namespace zerodrift::vision
