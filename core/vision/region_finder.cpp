#include "core/vision/region_finder.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr double least_eigenvalue = 2.0;  // mean over the window, grey levels^2 / px^2

// Sum over windows of this size, at the window's first pixel.
cv::Mat window_means(const cv::Mat& values, int size) {
  cv::Mat out;
  cv::boxFilter(values, out, CV_32F, {size, size}, {0, 0}, true, cv::BORDER_CONSTANT);
  return out(cv::Rect(0, 0, values.cols - size + 1, values.rows - size + 1));
}

}  // namespace

Result<Region> find_textured_region(const GrayImage& image, const std::string& name) {
  const int size = std::min(image.width, image.height) / 3;
  if (size < 24) return fail(ErrorCode::template_without_texture, {{"file", name}});
  cv::Mat smooth, gx, gy;
  mat_view(image).convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {0, 0}, 1.5);  // noise is no texture
  cv::Sobel(smooth, gx, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(smooth, gy, CV_32F, 0, 1, 3, 1.0 / 8);
  const cv::Mat xx = window_means(gx.mul(gx), size);
  const cv::Mat xy = window_means(gx.mul(gy), size);
  const cv::Mat yy = window_means(gy.mul(gy), size);
  cv::Mat root;
  cv::sqrt((xx - yy).mul(xx - yy) + 4.0 * xy.mul(xy), root);
  const cv::Mat smaller = 0.5 * (xx + yy - root);
  // Room to travel counts: a window at the border would leave the view with the first drift.
  cv::Mat score = smaller.clone();
  const int margin = size / 8;
  for (int y = 0; y < score.rows; ++y) {
    for (int x = 0; x < score.cols; ++x) {
      const int room = std::min({x, y, score.cols - 1 - x, score.rows - 1 - y});
      score.at<float>(y, x) *= static_cast<float>(std::min(1.0, 0.3 + 0.7 * room / std::max(margin, 1)));
    }
  }
  cv::Point best;
  cv::minMaxLoc(score, nullptr, nullptr, nullptr, &best);
  if (smaller.at<float>(best) < least_eigenvalue) return fail(ErrorCode::template_without_texture, {{"file", name}});
  return Region{best.x, best.y, size, size};
}

}  // namespace zerodrift::vision
