#include "core/vision/frame_patch.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace zerodrift::vision {
namespace {

constexpr int saturated_level = 252;
constexpr int smallest_spot_px = 30;
constexpr double flank_radii = 0.5;  // of the spot's radius: a Gaussian flank has lost most of its height there

double largest_spot_radius(const cv::Mat& saturated) {
  cv::Mat labels, figures, centres;
  const int count = cv::connectedComponentsWithStats(saturated, labels, figures, centres);
  int area = 0;
  for (int k = 1; k < count; ++k) area = std::max(area, figures.at<int>(k, cv::CC_STAT_AREA));
  return area < smallest_spot_px ? 0.0 : std::sqrt(area / M_PI);
}

}  // namespace

FramePatch::FramePatch(const GrayImage& frame, const Region& at, const Eigen::Matrix2d& blur_px2, bool wide_glare)
    : spline(blurred(crop(frame, at), blur_px2)), state(static_cast<std::size_t>(at.width) * at.height, seen) {
  cv::Mat dark(at.height, at.width, CV_8U, cv::Scalar(1));  // 0 where saturated
  bool any = false;
  for (int y = 0; y < at.height; ++y) {
    for (int x = 0; x < at.width; ++x) {
      const int fx = at.x + x;
      const int fy = at.y + y;
      if (fx < 0 || fy < 0 || fx >= frame.width || fy >= frame.height) {
        state[static_cast<std::size_t>(y) * at.width + x] = outside;
      } else if (frame.at(fx, fy) >= saturated_level) {
        dark.at<std::uint8_t>(y, x) = 0;
        any = true;
      }
    }
  }
  if (!any) return;
  // What a saturated pixel reaches through the spline and the blur, and the flank of a glaring spot.
  double reach = 2.0 + std::ceil(std::sqrt(blur_px2.trace()));
  if (wide_glare) reach += flank_radii * largest_spot_radius(1 - dark);
  cv::Mat distance;
  cv::distanceTransform(dark, distance, cv::DIST_L2, cv::DIST_MASK_3);
  for (int y = 0; y < at.height; ++y) {
    for (int x = 0; x < at.width; ++x) {
      std::uint8_t& one = state[static_cast<std::size_t>(y) * at.width + x];
      if (one == seen && distance.at<float>(y, x) <= reach) one = too_bright;
    }
  }
}

}  // namespace zerodrift::vision
