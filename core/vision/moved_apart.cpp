#include "core/vision/moved_apart.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"
#include "core/vision/window_likeness.h"

namespace zerodrift::vision {
namespace {

constexpr int sample_step_px = 2;      // of the samples
constexpr int apart_window = 9;        // samples
constexpr int searched_samples = 40;   // each way
constexpr double even_part = 0.05;     // of the region's variance: a window with less shows nothing
constexpr double least_part = 0.08;    // of the region: what is reflected in a ball moves with the lamp, and is less
constexpr double least_found = 0.5;    // of what does not fit, that is seen elsewhere and was not there before
constexpr double least_alike = 0.5;    // correlation of what does not fit with where it is looked for
constexpr double least_across = 0.1;   // of a window's squared gradients along the strongest direction, across it
constexpr double least_swapped = 0.3;  // of what is seen elsewhere: such windows
constexpr double clipped = 252.0;

// The frame as it would be with the target at rest, sampled over the region and around it.
cv::Mat1f put_back(const GrayImage& frame, const Region& region, const PixelPoint& named, const Registration& found,
                   const cv::Size& samples) {
  cv::Mat1f map_x(samples.height + 2 * searched_samples, samples.width + 2 * searched_samples), map_y(map_x.size());
  const Eigen::Vector2d point(named.x_px, named.y_px);
  for (int row = 0; row < map_x.rows; ++row) {
    for (int column = 0; column < map_x.cols; ++column) {
      const Eigen::Vector2d at(region.x + (column - searched_samples) * sample_step_px,
                               region.y + (row - searched_samples) * sample_step_px);
      const Eigen::Vector2d there = point + found.displacement_px + found.linear * (at - point);
      map_x(row, column) = static_cast<float>(there(0));
      map_y(row, column) = static_cast<float>(there(1));
    }
  }
  cv::Mat1f smooth, out;
  mat_view(frame).convertTo(smooth, CV_32F);
  cv::blur(smooth, smooth, {sample_step_px, sample_step_px}, {-1, -1}, cv::BORDER_REPLICATE);
  cv::remap(smooth, out, map_x, map_y, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  return out;
}

FloatImage held(const cv::Mat1f& values) {
  FloatImage out(values.cols, values.rows);
  values.copyTo(mat_view(out));
  return out;
}

cv::Mat1f at_shift(const cv::Mat1f& wide, const cv::Point& shift, const cv::Size& samples) {
  return wide(cv::Rect({searched_samples + shift.x, searched_samples + shift.y}, samples)).clone();
}

// Whether much of what the picture shows there tells a place along both axes: any edge is like a straight one, and any
// corner like a corner.
bool tells_both_ways(const cv::Mat1f& picture, const cv::Mat& there) {
  cv::Mat1f gx, gy;
  cv::Sobel(picture, gx, CV_32F, 1, 0);
  cv::Sobel(picture, gy, CV_32F, 0, 1);
  const auto around = [](const cv::Mat1f& a, const cv::Mat1f& b) {
    cv::Mat1f product, out;
    cv::multiply(a, b, product);
    cv::boxFilter(product, out, CV_32F, {apart_window, apart_window});
    return out;
  };
  const cv::Mat1f xx = around(gx, gx), xy = around(gx, gy), yy = around(gy, gy);
  int both = 0;
  for (int row = 0; row < picture.rows; ++row) {
    for (int column = 0; column < picture.cols; ++column) {
      if (there.at<std::uint8_t>(row, column) == 0) continue;
      const double middle = 0.5 * (xx(row, column) + yy(row, column));
      const double half_spread = std::hypot(0.5 * (xx(row, column) - yy(row, column)), xy(row, column));
      both += middle - half_spread > least_across * (middle + half_spread) ? 1 : 0;
    }
  }
  return both > least_swapped * cv::countNonZero(there);
}

}  // namespace

bool moved_apart(const GrayImage& image, const Region& region, const PixelPoint& point,
                 const std::vector<std::uint8_t>& usable, const GrayImage& frame, const Registration& found) {
  const cv::Size samples(region.width / sample_step_px, region.height / sample_step_px);
  Registration still;
  still.contrast = 1.0;
  const cv::Mat1f wide_then = put_back(image, region, point, still, samples);
  const cv::Mat1f wide_now = put_back(frame, region, point, found, samples);
  const cv::Mat1f shown = at_shift(wide_then, {0, 0}, samples);
  cv::Mat1f use(samples);
  for (int row = 0; row < use.rows; ++row) {
    for (int column = 0; column < use.cols; ++column) {
      const std::size_t k = static_cast<std::size_t>(row * sample_step_px) * region.width + column * sample_step_px;
      use(row, column) = usable[k] != 0 ? 1.0f : 0.0f;
    }
  }
  cv::Scalar mean, deviation;
  cv::meanStdDev(shown, mean, deviation);
  const double even_variance = even_part * deviation[0] * deviation[0];
  const auto likeness = [&](const cv::Mat1f& wide, const cv::Point& shift, double contrast) {
    const cv::Mat1f there = at_shift(wide, shift, samples);
    cv::Mat1f weight = use.clone();
    weight.setTo(0.0f, there >= clipped);
    const FloatImage told =
        window_likeness(held(shown), held(there), held(weight), apart_window, contrast, even_variance);
    return cv::Mat1f(mat_view(told).clone());
  };
  cv::Mat unlike = likeness(wide_now, {0, 0}, found.contrast) < 0.0f;
  cv::morphologyEx(unlike, unlike, cv::MORPH_OPEN, cv::Mat::ones(3, 3, CV_8U));
  const int unlike_count = cv::countNonZero(unlike);
  if (unlike_count < least_part * samples.area()) return false;
  cv::Mat1f part, scores;
  unlike.convertTo(part, CV_32F, 1.0 / 255.0);
  cv::matchTemplate(wide_now, shown, scores, cv::TM_CCOEFF_NORMED, part);
  scores.setTo(-1.0f, (scores != scores) | (scores > 1.1f));
  double best = 0.0;
  cv::Point place;
  cv::minMaxLoc(scores, nullptr, &best, nullptr, &place);
  const cv::Point shift(place.x - searched_samples, place.y - searched_samples);
  if (best < least_alike || (shift.x == 0 && shift.y == 0)) return false;
  // A bar behind a cover is like itself further along: what was there before has not come there.
  const cv::Mat come =
      (likeness(wide_now, shift, found.contrast) > 0.0f) & (likeness(wide_then, shift, 1.0) < 0.0f) & unlike;
  return cv::countNonZero(come) > least_found * unlike_count && tells_both_ways(shown, come);
}

}  // namespace zerodrift::vision
