// A sharp chequered plate whose squares are whole pixels wide, mounted straight: all its edges lie alike on the pixels,
// and what the sampling folded down of them does not average out.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/vision/target.h"

namespace zerodrift::vision {
namespace {

constexpr double plate_middle_x = 160.3;
constexpr double plate_middle_y = 119.6;
constexpr double square_px = 36.0;
constexpr double plate_half_px = 80.0;
constexpr double sharp_blur_px = 0.66;  // an optics' 0.6 and the pixel's own width
constexpr double grain_levels = 1.2;

double right_of(double distance) {
  return 0.5 * (1.0 + std::erf(distance / (sharp_blur_px * std::numbers::sqrt2)));
}

double within_plate(double at) {
  return right_of(plate_half_px + at) * right_of(plate_half_px - at);
}

// Plus and minus one in turns.
double wave(double at) {
  double out = -1.0;
  for (int k = -2; k <= 2; ++k) out += (k % 2 == 0 ? 2.0 : -2.0) * right_of(at - k * square_px);
  return out;
}

GrayImage chequered(double dx, double dy, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, grain_levels);
  GrayImage out{320, 240, std::vector<std::uint8_t>(320 * 240)};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double u = x - plate_middle_x - dx, v = y - plate_middle_y - dy;
      const double level = 115.0 - 70.0 * wave(u) * wave(v);
      const double plate = within_plate(u) * within_plate(v);
      out.at(x, y) =
          static_cast<std::uint8_t>(std::clamp(std::round(95.0 + plate * (level - 95.0) + noise(random)), 0.0, 255.0));
    }
  }
  return out;
}

TEST(AlongRows, SharpSquaresOfWholePixelsAreMeasuredAtEverySubpixelPosition) {
  double squares = 0.0;
  double of_stated = 0.0;
  constexpr int positions = 16;
  for (int k = 0; k < positions; ++k) {
    const auto target = Target::create(chequered(0.0, 0.0, 100 + k), {70, 30, 180, 180},
                                       PixelPoint{plate_middle_x, plate_middle_y}, "template.png");
    ASSERT_TRUE(target);
    const double dx = 3.0 + k / 16.0, dy = -2.0 + (5 * k % 16) / 16.0;
    const Location at = target->locate(chequered(dx, dy, 200 + k));
    ASSERT_TRUE(at.ok) << at.reason;
    squares += std::pow(at.x_px - dx, 2) + std::pow(at.y_px - dy, 2);
    of_stated += std::pow((at.x_px - dx) / at.sigma_x_px, 2) + std::pow((at.y_px - dy) / at.sigma_y_px, 2);
  }
  RecordProperty("rms_px", std::to_string(std::sqrt(squares / (2 * positions))));
  EXPECT_LT(std::sqrt(squares / (2 * positions)), 0.0018);
  EXPECT_LT(std::sqrt(of_stated / (2 * positions)), 1.6);
}

}  // namespace
}  // namespace zerodrift::vision
