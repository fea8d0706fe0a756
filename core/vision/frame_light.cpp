#include "core/vision/frame_light.h"

#include <Eigen/Cholesky>
#include <vector>

#include "core/vision/backdrop_sheet.h"
#include "core/vision/opencv_image.h"

namespace zerodrift::vision::backdrop {
namespace {

constexpr double light_length_px = 300.0;
// Means over blocks: single pixels' noise, as it is in both pictures, would pass for contrast that the frame lacks.
constexpr int light_block_px = 4;
constexpr int light_rounds_behind = 4;
constexpr std::size_t least_light_pixels = 500;
constexpr double light_prior = 30.0;  // pixels' worth, that the light is as it was: an even backdrop cannot tell
constexpr double same_light = 2.6;    // of the noise, that the still parts may differ by: else they moved

// Noise of a picture at its own levels.
double noise_in(const GrayImage& image) {
  cv::Mat levels;
  mat_view(image).convertTo(levels, CV_32F);
  return double{noise_of(levels)};
}

// Of a block from this pixel on; nothing where part of it is saturated.
std::optional<double> block_mean(const GrayImage& image, int x, int y) {
  int sum = 0;
  for (int row = y; row < y + light_block_px; ++row) {
    for (int column = x; column < x + light_block_px; ++column) {
      if (image.at(column, row) >= clipped_level) return std::nullopt;
      sum += image.at(column, row);
    }
  }
  return static_cast<double>(sum) / (light_block_px * light_block_px);
}

}  // namespace

float FrameLight::undone(double level, double x, double y) const {
  const Eigen::Vector2d w = (Eigen::Vector2d(x, y) - middle) / light_length_px;
  const double gain = factors(0) + factors(1) * w(0) + factors(2) * w(1);
  return gain > 0.1 ? static_cast<float>((level - factors(3)) / gain) : unknown;
}

std::optional<FrameLight> light_of(const GrayImage& picture, const Region& sheet, const RegisteredFrame& frame) {
  FrameLight out;
  out.middle = {picture.width / 2.0, picture.height / 2.0};
  std::vector<Eigen::Vector4d> rows;
  std::vector<double> levels, weights;
  const auto on_target = [&](double x, double y) {
    return x >= sheet.x && y >= sheet.y && x < sheet.x + sheet.width && y < sheet.y + sheet.height;
  };
  constexpr double middle_of_block = 0.5 * (light_block_px - 1);
  for (int y = 0; y + light_block_px <= picture.height; y += light_block_px) {
    for (int x = 0; x + light_block_px <= picture.width; x += light_block_px) {
      if (on_target(x, y) || on_target(x - frame.displacement_px.x(), y - frame.displacement_px.y())) continue;
      const auto level = block_mean(picture, x, y);
      const auto now = block_mean(*frame.image, x, y);
      if (!level || !now) continue;
      const Eigen::Vector2d w =
          (Eigen::Vector2d(x + middle_of_block, y + middle_of_block) - out.middle) / light_length_px;
      rows.emplace_back(*level, *level * w(0), *level * w(1), shot_noise_grey);
      levels.push_back(*now);
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
