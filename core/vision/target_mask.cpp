#include "core/vision/target_mask.h"

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr int saturated_level = 252;
constexpr double smooth_px = 1.5;  // noise is averaged over some 28 pixels before the frames are compared

cv::Mat moved_back(const MovedFrame& moved, const Region& region) {
  const cv::Mat back = (cv::Mat_<double>(2, 3) << 1, 0, region.x + moved.x_px, 0, 1, region.y + moved.y_px);
  cv::Mat frame, out;
  mat_view(*moved.frame).convertTo(frame, CV_32F);
  cv::warpAffine(frame, out, back, {region.width, region.height}, cv::INTER_CUBIC | cv::WARP_INVERSE_MAP,
                 cv::BORDER_REPLICATE);
  cv::GaussianBlur(out, out, {0, 0}, smooth_px);
  // The light's gain and offset may have changed between the frames.
  cv::Scalar mean, deviation;
  cv::meanStdDev(out, mean, deviation);
  return (out - mean[0]) / std::max(deviation[0], 1.0);
}

}  // namespace

std::vector<std::uint8_t> usable_pixels(const GrayImage& image, const Region& region) {
  cv::Mat saturated = mat_view(image)(cv::Rect(region.x, region.y, region.width, region.height)) >= saturated_level;
  cv::dilate(saturated, saturated, cv::Mat::ones(5, 5, CV_8U));
  std::vector<std::uint8_t> out(saturated.total());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = saturated.data[k] == 0;
  return out;
}

std::vector<std::uint8_t> travelling_pixels(const GrayImage& image, const Region& region,
                                            const std::vector<MovedFrame>& frames) {
  std::vector<cv::Mat> stack{moved_back({&image, 0.0, 0.0}, region)};
  int moved = 0;
  for (const MovedFrame& frame : frames) {
    stack.push_back(moved_back(frame, region));
    moved += std::hypot(frame.x_px, frame.y_px) > 2.0;
  }
  if (moved < 3) return {};
  cv::Mat mean = cv::Mat::zeros(region.height, region.width, CV_32F);
  cv::Mat square = mean.clone();
  for (const cv::Mat& one : stack) {
    mean += one;
    square += one.mul(one);
  }
  mean /= static_cast<double>(stack.size());
  square = square / static_cast<double>(stack.size()) - mean.mul(mean);
  cv::Mat gx, gy, steep, spread;
  cv::Sobel(mean, gx, CV_32F, 1, 0, 3, 1.0 / 8);
  cv::Sobel(mean, gy, CV_32F, 0, 1, 3, 1.0 / 8);
  cv::magnitude(gx, gy, steep);
  cv::sqrt(cv::max(square, 0.0), spread);
  // A pixel of the target varies by noise, by half a pixel of misfit on its edges (rotation), and by the light.
  cv::Mat still = spread > 0.06 + 0.5 * steep + 0.02 * cv::abs(mean);
  cv::morphologyEx(still, still, cv::MORPH_OPEN, cv::Mat::ones(3, 3, CV_8U));
  cv::dilate(still, still, cv::Mat::ones(3, 3, CV_8U));
  std::vector<std::uint8_t> out(still.total());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = still.data[k] == 0;
  return out;
}

}  // namespace zerodrift::vision
