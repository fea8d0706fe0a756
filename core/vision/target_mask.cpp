#include "core/vision/target_mask.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr int saturated_level = 252;
constexpr int mean_window_px = 5;        // residuals are averaged over it
constexpr double excess_limit = 2.2;     // mean square over the noise: above it the pixel does not belong to the target
constexpr float largest_square = 50.0f;  // a single outlier must not spoil its neighbours

// Mean square residual around each pixel, NaN where nothing is known.
cv::Mat local_squares(const std::vector<float>& map, const Region& region) {
  cv::Mat squares(region.height, region.width, CV_32F, cv::Scalar(0));
  cv::Mat known(region.height, region.width, CV_32F, cv::Scalar(0));
  for (std::size_t k = 0; k < map.size(); ++k) {
    if (std::isnan(map[k])) continue;
    squares.ptr<float>()[k] = std::min(map[k] * map[k], largest_square);
    known.ptr<float>()[k] = 1.0f;
  }
  cv::boxFilter(squares, squares, CV_32F, {mean_window_px, mean_window_px}, {-1, -1}, false, cv::BORDER_CONSTANT);
  cv::boxFilter(known, known, CV_32F, {mean_window_px, mean_window_px}, {-1, -1}, false, cv::BORDER_CONSTANT);
  return squares / known;  // 0 / 0 is NaN
}

}  // namespace

std::vector<std::uint8_t> usable_pixels(const GrayImage& image, const Region& region) {
  cv::Mat saturated = mat_view(image)(cv::Rect(region.x, region.y, region.width, region.height)) >= saturated_level;
  cv::dilate(saturated, saturated, cv::Mat::ones(5, 5, CV_8U));
  std::vector<std::uint8_t> out(saturated.total());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = saturated.data[k] == 0;
  return out;
}

std::vector<std::uint8_t> travelling_pixels(const Region& region,
                                            const std::vector<std::vector<float>>& residual_maps) {
  if (residual_maps.size() < 3) return {};
  std::vector<cv::Mat> stack;
  for (const std::vector<float>& map : residual_maps) stack.push_back(local_squares(map, region));
  std::vector<std::uint8_t> out(static_cast<std::size_t>(region.width) * region.height, 1);
  std::vector<float> values;
  for (std::size_t k = 0; k < out.size(); ++k) {
    values.clear();
    for (const cv::Mat& one : stack) {
      const float value = one.ptr<float>()[k];
      if (std::isfinite(value)) values.push_back(value);
    }
    if (values.size() < 3) continue;
    // The median: a chip or a highlight in some of the frames says nothing of the target.
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    out[k] = *middle <= static_cast<float>(excess_limit);
  }
  return out;
}

}  // namespace zerodrift::vision
