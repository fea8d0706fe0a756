#include "core/vision/backdrop_sheet.h"

#include <Eigen/LU>
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision::backdrop {
bool usable(const GrayImage& image, int x, int y) {
  if (x < 0 || y < 0 || x + 1 >= image.width || y + 1 >= image.height) return false;
  return std::max({image.at(x, y), image.at(x + 1, y), image.at(x, y + 1), image.at(x + 1, y + 1)}) < clipped_level;
}

FloatImage Sheet::of_template() const {
  FloatImage out = crop(m_picture, m_at);
  for (int row = 0; row < height(); ++row) {
    for (int column = 0; column < width(); ++column) {
      if (!usable(m_picture, m_at.x + column, m_at.y + row)) out.row(row)[column] = unknown;
    }
  }
  return out;
}

FloatImage Sheet::travelled(const LitFrame& frame) const {
  const int extra =
      12 +
      static_cast<int>(std::ceil((frame.linear - Eigen::Matrix2d::Identity()).norm() * std::max(width(), height())));
  const int dx = static_cast<int>(std::lround(frame.displacement_px.x()));
  const int dy = static_cast<int>(std::lround(frame.displacement_px.y()));
  const Region patch{m_at.x + dx - extra, m_at.y + dy - extra, width() + 2 * extra, height() + 2 * extra};
  const SplineImage spline(crop(*frame.image, patch));
  FloatImage out(width(), height());
  const std::size_t n = static_cast<std::size_t>(width());
  std::vector<int> places(n);
  std::vector<float> fx(n), fy(n);
  for (int row = 0; row < height(); ++row) {
    for (int column = 0; column < width(); ++column) {
      const Eigen::Vector2d seen = in_frame(column, row, frame) - Eigen::Vector2d(patch.x, patch.y);
      const int x = std::clamp(static_cast<int>(std::floor(seen.x())), 2, patch.width - SplineImage::reach_after);
      const int y = std::clamp(static_cast<int>(std::floor(seen.y())), 2, patch.height - SplineImage::reach_after);
      places[column] = y * patch.width + x;
      fx[column] = static_cast<float>(std::clamp(seen.x() - x, 0.0, 1.0));
      fy[column] = static_cast<float>(std::clamp(seen.y() - y, 0.0, 1.0));
    }
    spline.sample(places.data(), fx.data(), fy.data(), width(), out.row(row));
    for (int column = 0; column < width(); ++column) {
      const int x = patch.x + places[column] % patch.width;
      const int y = patch.y + places[column] / patch.width;
      out.row(row)[column] =
          usable(*frame.image, x, y) ? frame.light.undone(double{out.row(row)[column]}, x, y) : unknown;
    }
  }
  return out;
}

float middle_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Standard deviation of the noise in an image of differences, by its second differences along both axes (Immerkaer,
// Computer Vision and Image Understanding 64 (1996) 300), their median.
float noise_of(const cv::Mat& difference) {
  const cv::Mat kernel = (cv::Mat_<float>(3, 3) << 1, -2, 1, -2, 4, -2, 1, -2, 1);
  cv::Mat high;
  cv::filter2D(difference, high, CV_32F, kernel);
  std::vector<float> sizes;
  sizes.reserve(high.total());
  for (std::size_t k = 0; k < high.total(); ++k) sizes.push_back(std::abs(high.ptr<float>()[k]));
  return 1.4826f * middle_of(sizes) / 6.0f + 0.05f;
}

}  // namespace zerodrift::vision::backdrop
