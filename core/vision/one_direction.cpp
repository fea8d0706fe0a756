#include "core/vision/one_direction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

// Gradient energy along the direction that shows least over that across it: targets have 0.15 (milled arcs) and more,
// bars with their ends 0.025 to 0.056, brushed metal 0.01, bars alone what noise makes of it.
constexpr double least_energy_ratio = 0.1;
constexpr double noise_sigma_px = 1.5;  // of the blur that takes noise out, which has gradients in every direction
constexpr double upright_deg = 10.0;

}  // namespace

std::string unseen_direction(const GrayImage& image, const Region& region) {
  cv::Mat smooth, gx, gy;
  mat_view(image)(cv::Rect(region.x, region.y, region.width, region.height)).convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {0, 0}, noise_sigma_px);
  cv::Sobel(smooth, gx, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(smooth, gy, CV_32F, 0, 1, 3, 1.0 / 8);
  const double xx = gx.dot(gx), xy = gx.dot(gy), yy = gy.dot(gy);
  const double root = std::sqrt((xx - yy) * (xx - yy) + 4.0 * xy * xy);
  if (xx + yy - root >= least_energy_ratio * (xx + yy + root)) return "";
  // From x to the right towards y down, -90 to 90.
  const double across_rad = 0.5 * std::atan2(2.0 * xy, xx - yy);
  const double along_deg = 90.0 - std::abs(across_rad) * 180.0 / M_PI;
  const double times = std::sqrt((xx + yy + root) / std::max(xx + yy - root, 1e-6 * (xx + yy)));
  const std::string remedy = fmt::format("; {}", "choose a region or a target with structure in both directions");
  if (along_deg > 90.0 - upright_deg) {
    return fmt::format(
               "the region shows little but bars along y: a motion up and down (y) can hardly be seen, {:.0f} times "
               "less well than one across",
               times) +
           remedy;
  }
  if (along_deg < upright_deg) {
    return fmt::format(
               "the region shows little but bars along x: a motion from side to side (x) can hardly be seen, {:.0f} "
               "times less well than one across",
               times) +
           remedy;
  }
  const char* const slant = across_rad > 0.0 ? "rising to the right" : "falling to the right";
  return fmt::format(
             "the region shows little but bars {} at {:.0f} degrees to x: a motion along them can hardly be seen, "
             "{:.0f} times less well than one across",
             slant, along_deg, times) +
         remedy;
}

}  // namespace zerodrift::vision
