#pragma once
// Between GrayImage and cv::Mat. Only the .cpp files of this folder include it; public headers show no OpenCV type.

#include <opencv2/core.hpp>

#include "core/vision/image.h"
#include "core/vision/spline_image.h"

namespace zerodrift::vision {

/// A view of the same pixels; valid as long as the image lives.
inline cv::Mat mat_view(const GrayImage& image) {
  return cv::Mat(image.height, image.width, CV_8U, const_cast<std::uint8_t*>(image.pixels.data()));
}

inline cv::Mat mat_view(const FloatImage& image) {
  return cv::Mat(image.height, image.width, CV_32F, const_cast<float*>(image.values.data()));
}

inline GrayImage gray_from_mat(const cv::Mat& mat) {
  GrayImage image{mat.cols, mat.rows, std::vector<std::uint8_t>(mat.total())};
  mat.copyTo(mat_view(image));
  return image;
}

}  // namespace zerodrift::vision
