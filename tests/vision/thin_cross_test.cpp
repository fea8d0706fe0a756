// A cross-hair of thin lines before even paper: what little it shows is far from the middle, where a turn moves it by
// more than its width.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/vision/target.h"

namespace zerodrift::vision {
namespace {

constexpr double cross_middle_x = 160.3;
constexpr double cross_middle_y = 119.6;
constexpr double half_length_px = 80.0;
constexpr double half_width_px = 1.5;
constexpr double blur_px = 1.0;
constexpr double noise_levels = 1.0;
const Region cross_region{70, 30, 180, 180};

// 1 on a line, 0 beside it, with the optics' blur in between.
double inked(double along, double across) {
  const auto within = [](double at, double half) {
    return 0.5 * (std::erf((at + half) / (blur_px * std::numbers::sqrt2)) -
                  std::erf((at - half) / (blur_px * std::numbers::sqrt2)));
  };
  return within(along, half_length_px) * within(across, half_width_px);
}

GrayImage cross_hair(double dx, double dy, double turn_rad, double hidden_from_x, unsigned seed) {
  const double c = std::cos(turn_rad), s = std::sin(turn_rad);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, noise_levels);
  GrayImage out{320, 240, std::vector<std::uint8_t>(320 * 240)};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double u = x - cross_middle_x - dx, v = y - cross_middle_y - dy;
      const double along = c * u + s * v, across = c * v - s * u;
      const double ink = x < hidden_from_x ? std::max(inked(along, across), inked(across, along)) : 0.0;
      out.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::round(190.0 - 140.0 * ink + noise(random)), 0.0, 255.0));
    }
  }
  return out;
}

constexpr double whole = 1e3;
constexpr double degree = std::numbers::pi / 180.0;

TEST(ThinCross, IsMeasuredHoweverItTurns) {
  const auto target = Target::create(cross_hair(0.0, 0.0, 0.0, whole, 12), cross_region,
                                     PixelPoint{cross_middle_x, cross_middle_y}, "template.png");
  ASSERT_TRUE(target);
  for (const double turn_deg : {1.5, -1.5, 0.9, -1.9}) {
    const Location at = target->locate(cross_hair(3.27, -2.61, turn_deg * degree, whole, 2));
    ASSERT_TRUE(at.ok) << turn_deg << ": " << at.reason;
    EXPECT_NEAR(at.x_px, 3.27, 0.003) << turn_deg << " deg";
    EXPECT_NEAR(at.y_px, -2.61, 0.003) << turn_deg << " deg";
    EXPECT_NEAR(at.linear(1, 0), std::sin(turn_deg * degree), 5e-4);
  }
}

// The other starts are no way in for what is not the target.
TEST(ThinCross, IsRefusedWhereHardlyHalfOfItIsLeft) {
  const auto target = Target::create(cross_hair(0.0, 0.0, 0.0, whole, 12), cross_region,
                                     PixelPoint{cross_middle_x, cross_middle_y}, "template.png");
  ASSERT_TRUE(target);
  EXPECT_FALSE(target->locate(cross_hair(3.27, -2.61, 1.5 * degree, 130.0, 3)).ok);
  EXPECT_FALSE(target->locate(cross_hair(3.27, -2.61, 4.0 * degree, whole, 4)).ok);
}

}  // namespace
}  // namespace zerodrift::vision
