#include "core/vision/image_quality.h"

#include <algorithm>

namespace zerodrift::vision {
namespace {

int quantile(const std::array<int, 256>& histogram, double share, double count) {
  double sum = 0.0;
  for (int level = 0; level < 256; ++level) {
    sum += histogram[level];
    if (sum >= share * count) return level;
  }
  return 255;
}

}  // namespace

ImageQuality quality_of(const GrayImage& image, const Region& region) {
  ImageQuality out;
  if (image.empty()) return out;
  const Region at = inside(region, image) ? region : Region{0, 0, image.width, image.height};
  double sum = 0.0, square = 0.0, gradient = 0.0;
  for (int y = at.y; y < at.y + at.height; ++y) {
    for (int x = at.x; x < at.x + at.width; ++x) {
      const int value = image.at(x, y);
      ++out.histogram[value];
      sum += value;
      square += double(value) * value;
      if (x + 1 < at.x + at.width && y + 1 < at.y + at.height) {
        const int gx = image.at(x + 1, y) - value;
        const int gy = image.at(x, y + 1) - value;
        gradient += double(gx) * gx + double(gy) * gy;
      }
    }
  }
  const double count = static_cast<double>(at.width) * at.height;
  out.mean_level = sum / count;
  const double variance = square / count - out.mean_level * out.mean_level;
  out.sharpness = variance > 1.0 ? gradient / count / variance : 0.0;
  out.contrast_level = quantile(out.histogram, 0.95, count) - quantile(out.histogram, 0.05, count);
  for (int level = 0; level < 256; ++level) {
    if (level >= 252) out.saturated_share += out.histogram[level] / count;
    if (level <= 3) out.dark_share += out.histogram[level] / count;
  }
  return out;
}

ExposureAdvice exposure_advice(const ImageQuality& quality) {
  if (quality.saturated_share > 0.01) return ExposureAdvice::less_light;
  if (quality.mean_level < 50.0 || quality.dark_share > 0.25) return ExposureAdvice::more_light;
  if (quality.contrast_level < 50.0) return ExposureAdvice::more_contrast;
  return ExposureAdvice::good;
}

}  // namespace zerodrift::vision
