#include "core/vision/window_likeness.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr double least_correlation = 0.8;
constexpr double largest_gain_ratio = 2.0;  // of a window to the whole target, either way
constexpr double least_window = 0.3;        // of its pixels
constexpr double least_variance = 1e-3;     // grey levels^2

}  // namespace

FloatImage window_likeness(const FloatImage& in_template, const FloatImage& in_frame, const FloatImage& weight,
                           int window_px, double contrast, double even_variance) {
  const cv::Mat1f t = mat_view(in_template), g = mat_view(in_frame), w = mat_view(weight);
  const auto mean = [&](const cv::Mat1f& values) {
    cv::Mat1f out;
    cv::boxFilter(values, out, CV_32F, {window_px, window_px}, {-1, -1}, true, cv::BORDER_CONSTANT);
    return out;
  };
  cv::Mat1f wt, wg, product;
  cv::multiply(w, t, wt);
  cv::multiply(w, g, wg);
  const auto mean_of = [&](const cv::Mat1f& a, const cv::Mat1f& b) {
    cv::multiply(a, b, product);
    return mean(product);
  };
  const cv::Mat1f count = mean(w), mean_t = mean(wt), mean_g = mean(wg);
  const cv::Mat1f tt = mean_of(wt, t), gg = mean_of(wg, g), tg = mean_of(wt, g);
  FloatImage out(in_template.width, in_template.height);
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      const double n = count(row, column);
      if (w(row, column) == 0.0f || n < least_window) continue;
      const double level_t = mean_t(row, column) / n;
      const double level_g = mean_g(row, column) / n;
      const double square_t = std::max(tt(row, column) / n - level_t * level_t, least_variance);
      const double square_g = std::max(gg(row, column) / n - level_g * level_g, least_variance);
      const double both = tg(row, column) / n - level_t * level_g;
      const double gain = both / square_t / std::max(contrast, 1e-3);
      const bool even = square_t < even_variance && square_g < even_variance * contrast * contrast;
      const bool alike = even || (both > least_correlation * std::sqrt(square_t * square_g) &&
                                  gain < largest_gain_ratio && gain > 1.0 / largest_gain_ratio);
      out.row(row)[column] = alike ? 1.0f : -1.0f;
    }
  }
  return out;
}

}  // namespace zerodrift::vision
