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

FramePatch::FramePatch(const GrayImage& frame, const Region& region, const Eigen::Matrix2d& blur)
    : at(region),
      blur_px2(blur),
      spline(blurred(crop(frame, at), blur)),
      state(static_cast<std::size_t>(at.width) * at.height, seen) {
  int left = at.width, top = at.height, right = -1, bottom = -1;
  for (int y = 0; y < at.height; ++y) {
    std::uint8_t* here = state.data() + static_cast<std::size_t>(y) * at.width;
    const int fy = at.y + y;
    if (fy < 0 || fy >= frame.height) {
      std::fill_n(here, at.width, outside);
      continue;
    }
    const std::uint8_t* levels = frame.pixels.data() + static_cast<std::size_t>(fy) * frame.width;
    for (int x = 0; x < at.width; ++x) {
      const int fx = at.x + x;
      if (fx < 0 || fx >= frame.width) {
        here[x] = outside;
      } else if (levels[fx] >= saturated_level) {
        if (m_dark.empty()) m_dark.assign(state.size(), 1);
        m_dark[static_cast<std::size_t>(y) * at.width + x] = 0;
        left = std::min(left, x), right = std::max(right, x);
        top = std::min(top, y), bottom = std::max(bottom, y);
      }
    }
  }
  if (!m_dark.empty()) m_bright = {left, top, right - left + 1, bottom - top + 1};
  leave_out_bright(0.0);
}

// What a saturated pixel reaches through the spline and the blur, and further. Only the surroundings of the saturated
// pixels are looked at: distances over the whole patch would take longer than all else here.
void FramePatch::leave_out_bright(double further_px) {
  if (m_dark.empty()) return;
  const double reach = 2.0 + std::ceil(std::sqrt(blur_px2.trace())) + further_px;
  const int border = static_cast<int>(std::ceil(reach)) + 1;
  const cv::Mat dark(spline.height(), spline.width(), CV_8U, m_dark.data());
  const cv::Rect around(m_bright.x - border, m_bright.y - border, m_bright.width + 2 * border,
                        m_bright.height + 2 * border);
  const cv::Rect box = around & cv::Rect(0, 0, dark.cols, dark.rows);
  cv::Mat distance;
  cv::distanceTransform(dark(box), distance, cv::DIST_L2, cv::DIST_MASK_3);
  for (int y = 0; y < box.height; ++y) {
    std::uint8_t* to = state.data() + static_cast<std::size_t>(box.y + y) * spline.width() + box.x;
    for (int x = 0; x < box.width; ++x) {
      if (to[x] == seen && distance.at<float>(y, x) <= reach) to[x] = too_bright;
    }
  }
}

void FramePatch::widen_glare() {
  if (m_dark.empty()) return;
  const cv::Mat dark(spline.height(), spline.width(), CV_8U, m_dark.data());
  const cv::Rect box(m_bright.x, m_bright.y, m_bright.width, m_bright.height);
  leave_out_bright(flank_radii * largest_spot_radius(1 - dark(box)));
}

}  // namespace zerodrift::vision
