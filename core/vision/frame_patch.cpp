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

FramePatch::FramePatch(const GrayImage& frame, const Region& at, const Eigen::Matrix2d& blur)
    : blur_px2(blur),
      spline(blurred(crop(frame, at), blur)),
      state(static_cast<std::size_t>(at.width) * at.height, seen) {
  for (int y = 0; y < at.height; ++y) {
    for (int x = 0; x < at.width; ++x) {
      const std::size_t here = static_cast<std::size_t>(y) * at.width + x;
      const int fx = at.x + x;
      const int fy = at.y + y;
      if (fx < 0 || fy < 0 || fx >= frame.width || fy >= frame.height) {
        state[here] = outside;
      } else if (frame.at(fx, fy) >= saturated_level) {
        if (m_dark.empty()) m_dark.assign(state.size(), 1);
        m_dark[here] = 0;
      }
    }
  }
  leave_out_bright(0.0);
}

// What a saturated pixel reaches through the spline and the blur, and further.
void FramePatch::leave_out_bright(double further_px) {
  if (m_dark.empty()) return;
  const double reach = 2.0 + std::ceil(std::sqrt(blur_px2.trace())) + further_px;
  cv::Mat distance;
  cv::distanceTransform(cv::Mat(spline.height(), spline.width(), CV_8U, m_dark.data()), distance, cv::DIST_L2,
                        cv::DIST_MASK_3);
  for (std::size_t k = 0; k < state.size(); ++k) {
    if (state[k] == seen && distance.ptr<float>()[k] <= reach) state[k] = too_bright;
  }
}

void FramePatch::widen_glare() {
  if (m_dark.empty()) return;
  const cv::Mat dark(spline.height(), spline.width(), CV_8U, m_dark.data());
  leave_out_bright(flank_radii * largest_spot_radius(1 - dark));
}

}  // namespace zerodrift::vision
