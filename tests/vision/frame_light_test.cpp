#include "core/vision/frame_light.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace zerodrift::vision::backdrop {
namespace {

// A backdrop of little contrast, in a noise as large.
GrayImage faint_backdrop(unsigned seed, double gain) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0.0, 3.0);
  GrayImage out{640, 480, std::vector<std::uint8_t>(640 * 480)};
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const double level = gain * (90.0 + 4.0 * std::sin(x / 40.0) * std::cos(y / 30.0)) + noise(generator);
      out.pixels[static_cast<std::size_t>(y) * 640 + x] =
          static_cast<std::uint8_t>(std::lround(std::clamp(level, 0.0, 255.0)));
    }
  }
  return out;
}

TEST(FrameLight, NoiseIsNotTakenForALossOfContrast) {
  const GrayImage before = faint_backdrop(1, 1.0);
  const GrayImage now = faint_backdrop(2, 1.0);
  const auto light =
      light_of(before, {240, 160, 160, 160}, {&now, Eigen::Vector2d(10.0, 5.0), Eigen::Matrix2d::Identity(), {}});
  ASSERT_TRUE(light);
  // A dark target and its highlight, far from the backdrop's own levels.
  EXPECT_NEAR(light->undone(30.0, 320.0, 240.0), 30.0, 1.5);
  EXPECT_NEAR(light->undone(200.0, 320.0, 240.0), 200.0, 3.0);
}

}  // namespace
}  // namespace zerodrift::vision::backdrop
