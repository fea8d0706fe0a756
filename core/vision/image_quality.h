#pragma once
// Help with focus and exposure: one figure for sharpness to turn the lens by, the histogram, the clipped shares.

#include <array>
#include <string_view>

#include "core/vision/image.h"

namespace zerodrift::vision {

struct ImageQuality {
  double sharpness = 0.0;        // mean squared gradient over variance: rises to focus, does not change with the light
  double blur_px = 0.0;          // sigma of the blur as edges show it, whatever the pattern; NaN without texture
  double largest_blur_px = 0.0;  // along x or along y: a motion smears one of them
  double mean_level = 0.0;       // grey levels
  double bright_level = 0.0;     // 95 % quantile
  double contrast_level = 0.0;   // 95 % quantile less 5 % quantile
  double saturated_share = 0.0;  // of pixels at the white end
  double dark_share = 0.0;       // of pixels at the black end
  std::array<int, 256> histogram{};
};

enum class ExposureAdvice { good, more_light, less_light, more_contrast };

/// Of the region, or of the whole image when the region is empty or not inside.
ImageQuality quality_of(const GrayImage& image, const Region& region = {});
ExposureAdvice exposure_advice(const ImageQuality& quality);

}  // namespace zerodrift::vision
