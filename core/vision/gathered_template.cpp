#include "core/vision/gathered_template.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/backdrop_sheet.h"
#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr std::size_t least_frames = 5;
constexpr int alike_window_px = 5;  // over which squares are averaged
// Mean square of what the frames differ by over the noise's: up to the first they are alike, from the second on not.
constexpr float alike_square = 1.6f;
constexpr float unlike_square = 2.6f;

// Of a frame laid onto the template: what stands behind as it was there.
void put_backdrop_back(const backdrop::Sheet& sheet, const RegisteredFrame& frame, const Backdrop& behind,
                       FloatImage& laid) {
  for (int row = 0; row < laid.height; ++row) {
    for (int column = 0; column < laid.width; ++column) {
      const float clear = behind.clear.row(row)[column];
      if (clear <= 0.0f) continue;
      const Eigen::Vector2d there = sheet.in_frame(column, row, {frame, {}});
      const float now = behind.at(static_cast<float>(there.x()), static_cast<float>(there.y()));
      const float then = behind.at(static_cast<float>(sheet.at().x + column), static_cast<float>(sheet.at().y + row));
      laid.row(row)[column] -= clear * (now - then);
    }
  }
}

}  // namespace

std::optional<FloatImage> gathered_pixels(const GrayImage& picture, const Region& region, const PixelPoint& point,
                                          const std::vector<RegisteredFrame>& frames, const Backdrop* backdrop) {
  using backdrop::is_known;
  const backdrop::Sheet sheet(picture, region, point);
  const FloatImage own = crop(picture, sheet.at());
  std::vector<FloatImage> laid;
  for (const RegisteredFrame& one : frames) {
    const auto light = backdrop::light_of(picture, sheet.at(), one);
    if (!light) continue;
    laid.push_back(sheet.travelled({one, *light}));
    if (backdrop != nullptr) put_backdrop_back(sheet, one, *backdrop, laid.back());
  }
  if (laid.size() < least_frames) return std::nullopt;
  FloatImage mean(own.width, own.height);
  cv::Mat squares(own.height, own.width, CV_32F, cv::Scalar(0));
  const auto n = static_cast<float>(laid.size());
  // The noise of each frame's difference to the template, by which squares are measured.
  std::vector<float> noise;
  for (const FloatImage& one : laid) {
    cv::Mat difference(own.height, own.width, CV_32F, cv::Scalar(0));
    for (std::size_t k = 0; k < own.values.size(); ++k) {
      if (is_known(one.values[k])) difference.ptr<float>()[k] = one.values[k] - own.values[k];
    }
    noise.push_back(backdrop::noise_of(difference));
  }
  std::sort(noise.begin(), noise.end());
  const float usual = noise[noise.size() / 2];
  for (std::size_t k = 0; k < own.values.size(); ++k) {
    float sum = 0.0f;
    bool known = true;
    for (const FloatImage& one : laid) {
      known = known && is_known(one.values[k]);
      sum += one.values[k];
    }
    mean.values[k] = known ? sum / n : own.values[k];
    float square = 0.0f;
    for (const FloatImage& one : laid) {
      square += known ? (one.values[k] - own.values[k]) * (one.values[k] - own.values[k]) : 100.0f * usual * usual;
    }
    squares.ptr<float>()[k] = square / (n * usual * usual);
  }
  cv::boxFilter(squares, squares, CV_32F, {alike_window_px, alike_window_px}, {-1, -1}, true, cv::BORDER_REPLICATE);
  for (std::size_t k = 0; k < own.values.size(); ++k) {
    const float share =
        std::clamp((unlike_square - squares.ptr<float>()[k]) / (unlike_square - alike_square), 0.0f, 1.0f);
    mean.values[k] = own.values[k] + share * (mean.values[k] - own.values[k]);
  }
  return mean;
}

}  // namespace zerodrift::vision
