#include "core/vision/target_mask.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/backdrop_sheet.h"
#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr int saturated_level = 252;
constexpr int mean_window_px = 5;        // residuals are averaged over it
constexpr double excess_limit = 2.2;     // mean square over the noise: above it the pixel does not belong to the target
constexpr float largest_square = 50.0f;  // a single outlier must not spoil its neighbours
constexpr float foreign_square = 9.0f;   // three standard deviations all around a pixel: it shows something else
constexpr float fitting = 2.5f;          // standard deviations: the pixel shows the target
constexpr double least_fitting = 200.0;  // pixels, to compare the light by
constexpr double light_share = 0.1;      // of the contrast
constexpr std::size_t least_frames = 3;

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

// The light is told by what fits: what lies over the target may lie over most of its surroundings too.
std::vector<std::uint8_t> pixels_under_a_cover(const GrayImage& picture, const Region& region, const PixelPoint& point,
                                               const RegisteredFrame& frame, const std::vector<float>& residual_map) {
  const Eigen::Vector2d named(point.x_px, point.y_px);
  const auto place_of = [&](std::size_t k) {
    const Eigen::Vector2d from(region.x + static_cast<int>(k) % region.width,
                               region.y + static_cast<int>(k) / region.width);
    const Eigen::Vector2d at = named + frame.displacement_px + frame.linear * (from - named);
    return std::array{static_cast<int>(std::lround(at.x())), static_cast<int>(std::lround(at.y()))};
  };
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d right = Eigen::Vector2d::Zero();
  for (std::size_t k = 0; k < residual_map.size(); ++k) {
    const auto [x, y] = place_of(k);
    if (!(std::abs(residual_map[k]) < fitting) || !backdrop::usable(*frame.image, x, y)) continue;
    const int level =
        picture.at(region.x + static_cast<int>(k) % region.width, region.y + static_cast<int>(k) / region.width);
    const Eigen::Vector2d here(level, 1.0);
    normal += here * here.transpose();
    right += static_cast<double>(frame.image->at(x, y)) * here;
  }
  if (normal(1, 1) < least_fitting) return {};
  const Eigen::Vector2d light = normal.ldlt().solve(right);
  cv::Mat1f change(region.height, region.width, 0.0f);
  std::vector<float> stood(residual_map.size(), std::nanf(""));
  for (std::size_t k = 0; k < residual_map.size(); ++k) {
    const auto [x, y] = place_of(k);
    if (!backdrop::usable(*frame.image, x, y) || !backdrop::usable(picture, x, y)) continue;
    const double left = frame.image->at(x, y) - light(0) * picture.at(x, y) - light(1);
    stood[k] = change.ptr<float>()[k] = static_cast<float>(left);
  }
  // The light is known to some share of the contrast only, which in a clear picture is more than the noise.
  cv::Scalar mean, contrast;
  cv::meanStdDev(mat_view(picture)(cv::Rect(region.x, region.y, region.width, region.height)), mean, contrast);
  const float same = std::hypot(backdrop::noise_of(change), static_cast<float>(light_share * light(0) * contrast[0]));
  for (float& one : stood) one /= same;
  const cv::Mat1f of_target = local_squares(residual_map, region), of_what_stood = local_squares(stood, region);
  std::vector<std::uint8_t> out(residual_map.size());
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = of_target.ptr<float>()[k] > foreign_square && of_what_stood.ptr<float>()[k] > foreign_square;
  }
  return out;
}

std::vector<std::uint8_t> travelling_pixels(const Region& region, const std::vector<ShownFrame>& frames) {
  if (frames.size() < least_frames) return {};
  std::vector<cv::Mat> stack;
  for (const ShownFrame& one : frames) stack.push_back(local_squares(one.residual_map, region));
  std::vector<std::uint8_t> out(static_cast<std::size_t>(region.width) * region.height, 1);
  std::vector<float> values, uncovered;
  for (std::size_t k = 0; k < out.size(); ++k) {
    values.clear(), uncovered.clear();
    for (std::size_t one = 0; one < stack.size(); ++one) {
      const float value = stack[one].ptr<float>()[k];
      if (!std::isfinite(value)) continue;
      values.push_back(value);
      const std::vector<std::uint8_t>& covers = frames[one].under_a_cover;
      if (covers.empty() || covers[k] == 0) uncovered.push_back(value);
    }
    // What nearly all frames hide is as good as what does not travel.
    const std::size_t enough = std::max(least_frames, values.size() / 4);
    if (uncovered.size() >= enough) values.swap(uncovered);
    if (values.size() < least_frames) continue;
    // The median: a chip or a highlight in some of the frames says nothing of the target.
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    out[k] = *middle <= static_cast<float>(excess_limit);
  }
  return out;
}

}  // namespace zerodrift::vision
