#include "core/vision/backdrop_sheet.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision::backdrop {
namespace {

constexpr int clipped_level = 252;
constexpr double light_length_px = 300.0;
constexpr int light_step_px = 4;  // every fourth pixel of every fourth row tells the light well enough
constexpr int light_rounds_behind = 4;
constexpr std::size_t least_light_pixels = 500;
constexpr double light_prior = 30.0;  // pixels' worth, that the light is as it was: an even backdrop cannot tell
constexpr double same_light = 3.0;    // of the noise, that the still parts may differ by: else they moved

// Noise of a picture at its own levels.
double noise_in(const GrayImage& image) {
  cv::Mat levels;
  mat_view(image).convertTo(levels, CV_32F);
  return double{noise_of(levels)};
}

}  // namespace

bool usable(const GrayImage& image, int x, int y) {
  if (x < 0 || y < 0 || x + 1 >= image.width || y + 1 >= image.height) return false;
  return std::max({image.at(x, y), image.at(x + 1, y), image.at(x, y + 1), image.at(x + 1, y + 1)}) < clipped_level;
}

float FrameLight::undone(double level, double x, double y) const {
  const Eigen::Vector2d w = (Eigen::Vector2d(x, y) - middle) / light_length_px;
  const double gain = factors(0) + factors(1) * w(0) + factors(2) * w(1);
  return gain > 0.1 ? static_cast<float>((level - factors(3)) / gain) : unknown;
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

std::optional<FrameLight> light_of(const GrayImage& picture, const Region& sheet, const RegisteredFrame& frame) {
  FrameLight out;
  out.middle = {picture.width / 2.0, picture.height / 2.0};
  std::vector<Eigen::Vector4d> rows;
  std::vector<double> levels, weights;
  const auto on_target = [&](double x, double y) {
    return x >= sheet.x && y >= sheet.y && x < sheet.x + sheet.width && y < sheet.y + sheet.height;
  };
  for (int y = 0; y < picture.height; y += light_step_px) {
    for (int x = 0; x < picture.width; x += light_step_px) {
      if (on_target(x, y) || on_target(x - frame.displacement_px.x(), y - frame.displacement_px.y())) continue;
      const double level = picture.at(x, y);
      if (level >= clipped_level || frame.image->at(x, y) >= clipped_level) continue;
      const Eigen::Vector2d w = (Eigen::Vector2d(x, y) - out.middle) / light_length_px;
      rows.emplace_back(level, level * w(0), level * w(1), shot_noise_grey);
      levels.push_back(frame.image->at(x, y));
    }
  }
  if (rows.size() < least_light_pixels) return out;  // a target that fills the picture: taken as unchanged
  weights.assign(rows.size(), 1.0);
  std::vector<float> sizes(rows.size());
  double scale = 0.0;
  for (int round = 0; round < light_rounds_behind; ++round) {
    Eigen::Matrix4d normal = light_prior * shot_noise_grey * shot_noise_grey * Eigen::Matrix4d::Identity();
    Eigen::Vector4d right = normal.col(0);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      normal += weights[k] * rows[k] * rows[k].transpose();
      right += weights[k] * levels[k] * rows[k];
    }
    out.factors = normal.ldlt().solve(right);
    for (std::size_t k = 0; k < rows.size(); ++k) {
      sizes[k] = static_cast<float>(std::abs(levels[k] - rows[k].dot(out.factors)));
    }
    std::vector<float> sorted = sizes;
    scale = 1.4826 * double{middle_of(sorted)} + 0.1;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const double u = double{sizes[k]} / (4.0 * scale);
      weights[k] = u < 1.0 ? (1.0 - u * u) * (1.0 - u * u) : 0.0;
    }
  }
  out.factors(3) *= shot_noise_grey;
  return scale < same_light * noise_in(*frame.image) ? std::optional(out) : std::nullopt;
}

}  // namespace zerodrift::vision::backdrop
