#include "core/vision/image_quality.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

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

/// Squared gradients along x and y, smoothed by sigma, grey levels^2 / px^2.
struct Energy {
  double x = 0.0, y = 0.0;
};

Energy energy_of(const cv::Mat& part, double sigma_px) {
  cv::Mat smooth, gx, gy;
  part.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {0, 0}, sigma_px, sigma_px, cv::BORDER_REPLICATE);
  cv::Sobel(smooth, gx, CV_32F, 1, 0, 1, 0.5, 0.0, cv::BORDER_REPLICATE);
  cv::Sobel(smooth, gy, CV_32F, 0, 1, 1, 0.5, 0.0, cv::BORDER_REPLICATE);
  const double count = static_cast<double>(part.total());
  return {cv::norm(gx, cv::NORM_L2SQR) / count, cv::norm(gy, cv::NORM_L2SQR) / count};
}

// The squared gradient of an edge that is blurred by sigma falls as 1 / sigma. Two further blurs of known size tell by
// their ratio what was there before: (sigma^2 + s1^2) / (sigma^2 + s2^2) = (E2 / E1)^2. The first keeps noise out.
struct Blur {
  double px = 0.0;
  double largest_px = 0.0;  // of the directions x and y: a motion smears one of them
};

Blur blur_of(const GrayImage& image, const Region& at) {
  constexpr double first_px = 1.0;
  constexpr double second_px = 2.0;
  constexpr double least_energy = 0.5;  // below it is no texture
  const cv::Mat part = mat_view(image)(cv::Rect(at.x, at.y, at.width, at.height));
  const Energy fine = energy_of(part, first_px), coarse = energy_of(part, second_px);
  const auto blur = [&](double e1, double e2) {
    if (e1 < least_energy) return std::nan("");
    const double ratio = std::pow(e2 / e1, 2);
    const double variance = (ratio * second_px * second_px - first_px * first_px) / std::max(1.0 - ratio, 1e-3);
    return std::sqrt(std::max(variance, 0.0));
  };
  return {blur(fine.x + fine.y, coarse.x + coarse.y), std::fmax(blur(fine.x, coarse.x), blur(fine.y, coarse.y))};
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
  out.bright_level = quantile(out.histogram, 0.95, count);
  const Blur blur = blur_of(image, at);
  out.blur_px = blur.px;
  out.largest_blur_px = blur.largest_px;
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
