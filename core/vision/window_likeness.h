#pragma once
// Where a frame shows the template, window by window: light is even over a window, so that only what is in the way
// counts there.

#include "core/vision/spline_image.h"

namespace zerodrift::vision {

/// Of images of one size and the weight of each of their pixels: 1 where the window around a pixel is like that of the
/// template, -1 where it is not, 0 where too little of it has weight. `contrast`: expected gain over the template.
/// Windows of both below `even_variance` (grey levels^2 of the template) are alike: neither shows anything.
FloatImage window_likeness(const FloatImage& in_template, const FloatImage& in_frame, const FloatImage& weight,
                           int window_px, double contrast, double even_variance = 0.0);

}  // namespace zerodrift::vision
