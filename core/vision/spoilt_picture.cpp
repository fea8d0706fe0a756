#include "core/vision/spoilt_picture.h"

#include <algorithm>
#include <cmath>

#include "core/vision/image_quality.h"

namespace zerodrift::vision {
namespace {

Region moved_within(Region region, const Eigen::Vector2d& by_px, const GrayImage& image) {
  const auto moved = [](int from, double by, int most) {
    return std::clamp(from + static_cast<int>(std::lround(by)), 0, std::max(0, most));
  };
  region.x = moved(region.x, by_px(0), image.width - region.width);
  region.y = moved(region.y, by_px(1), image.height - region.height);
  return region;
}

}  // namespace

Refusal told_by_the_picture(Refusal why, const GrayImage& frame, const GrayImage& at_rest, const Region& region,
                            const Eigen::Vector2d& displacement_px) {
  constexpr double burnt_out = 0.10;      // of the pixels, beyond the template's
  constexpr double least_contrast = 0.2;  // of the template's
  constexpr double blur_px2 = 2.5;        // beyond the template's
  if (why != Refusal::occluded && why != Refusal::wrong_target && why != Refusal::too_different) return why;
  const ImageQuality seen = quality_of(frame, moved_within(region, displacement_px, frame));
  const ImageQuality expected = quality_of(at_rest, region);
  if (seen.saturated_share - expected.saturated_share > burnt_out) return Refusal::glare;
  if (seen.contrast_level < least_contrast * expected.contrast_level) return Refusal::dim;
  const auto squared = [](double px) { return px * px; };
  if (squared(seen.largest_blur_px) - squared(expected.largest_blur_px) > blur_px2) return Refusal::blurred;
  return why;
}

}  // namespace zerodrift::vision
