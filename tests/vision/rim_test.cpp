// Balls whose own grey levels lie on both sides of those behind them, or near them, under a lamp that moves: what they
// show within their rim carries no place, and the rim's contrast changes with it, even its sign.

#include "core/vision/rim.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

#include "core/vision/target.h"

namespace zerodrift::vision {
namespace {

struct Scene {
  double dark, bright, behind;  // of the ball, and beside it
  double radius_px;
};

struct Shot {
  double dx = 0.0, dy = 0.0;          // px
  double lamp_x = 0.0, lamp_y = 0.0;  // beside where it stood
  unsigned seed = 1;
};

constexpr double middle_x = 321.3, middle_y = 238.6;

// A matt ball with a highlight, lit from the side; its edge blurred by 0.9 px, noise of 2 grey levels.
GrayImage ball_of(const Scene& scene, const Shot& shot) {
  GrayImage out{640, 480, std::vector<std::uint8_t>(640 * 480)};
  std::mt19937 random(shot.seed);
  std::normal_distribution<double> noise(0.0, 2.0);
  const double lamp_x = 0.3 + shot.lamp_x, lamp_y = -0.2 + shot.lamp_y;
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      const double x = (column - middle_x - shot.dx) / scene.radius_px;
      const double y = (row - middle_y - shot.dy) / scene.radius_px;
      const double r = std::hypot(x, y);
      const double z = std::sqrt(std::max(1.0 - r * r, 0.0));
      const double matt =
          std::clamp((x * lamp_x + y * lamp_y + z) / std::sqrt(1 + lamp_x * lamp_x + lamp_y * lamp_y), 0.0, 1.0);
      const double glint = std::exp(-(std::pow(x - 0.6 * lamp_x, 2) + std::pow(y - 0.6 * lamp_y, 2)) / 0.03);
      const double ball = scene.dark + 0.8 * (scene.bright - scene.dark) * (matt + 0.25 * glint);
      const double inside = 0.5 * std::erfc((r - 1.0) * scene.radius_px / (std::sqrt(2.0) * 0.9));
      const double level = scene.behind + inside * (ball - scene.behind) + noise(random);
      out.pixels[static_cast<std::size_t>(row) * 640 + column] =
          static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    }
  }
  return out;
}

class BallUnderAMovingLamp : public ::testing::TestWithParam<Scene> {};

TEST_P(BallUnderAMovingLamp, IsFoundByItsRimAndSaysHowWell) {
  const Scene scene = GetParam();
  const int half = static_cast<int>(scene.radius_px) + 14;
  const Region around{321 - half, 239 - half, 2 * half, 2 * half};
  const auto target = Target::create(ball_of(scene, {}), around, PixelPoint{middle_x, middle_y}, "ball.png");
  ASSERT_TRUE(target) << "no target";
  double squares = 0.0;
  int measured = 0;
  for (int k = 0; k < 8; ++k) {
    const double turn = 0.8 * k;
    const Shot shot{.dx = 4.3 * std::cos(1.9 * k),
                    .dy = 3.7 * std::sin(1.3 * k),
                    .lamp_x = 0.08 * std::cos(turn),
                    .lamp_y = 0.08 * std::sin(turn),
                    .seed = 100 + static_cast<unsigned>(k)};
    const Location at = target->locate(ball_of(scene, shot));
    if (!at.ok) continue;
    ++measured;
    const double ex = (at.x_px - shot.dx) / at.sigma_x_px, ey = (at.y_px - shot.dy) / at.sigma_y_px;
    squares += ex * ex + ey * ey;
    EXPECT_LT(std::max(std::abs(ex), std::abs(ey)), 4.0) << k;
    EXPECT_LT(std::hypot(at.x_px - shot.dx, at.y_px - shot.dy), 0.25) << k;
  }
  EXPECT_GE(measured, 7);
  EXPECT_LT(std::sqrt(squares / (2.0 * measured)), 1.8);
}

INSTANTIATE_TEST_SUITE_P(Levels, BallUnderAMovingLamp,
                         ::testing::Values(Scene{60, 200, 110, 84.0}, Scene{60, 180, 80, 70.0},
                                           Scene{100, 200, 150, 92.0}, Scene{80, 170, 200, 66.0},
                                           Scene{40, 120, 200, 78.0}));

// What is known to stand behind is taken off as far as the ball leaves it free: for a ball darker than that, as for a
// brighter one, a step outwards takes off less.
TEST(Rim, IsFollowedBeforeWhatIsKnownToStandBehindIt) {
  constexpr double radius_px = 80.0, behind = 110.0;
  auto backdrop = std::make_shared<Backdrop>();
  backdrop->area = {0, 0, 640, 480};
  backdrop->levels = FloatImage(640, 480);
  backdrop->clear = FloatImage(224, 224);
  for (int row = 0; row < 480; ++row) {
    for (int column = 0; column < 640; ++column) {
      backdrop->levels.row(row)[column] =
          static_cast<float>(behind + 15.0 * std::sin(0.21 * column) * std::cos(0.17 * row));
    }
  }
  const auto before_it = [&](const Scene& scene, const Shot& shot) {
    GrayImage out = ball_of(scene, shot);
    for (int row = 0; row < 480; ++row) {
      for (int column = 0; column < 640; ++column) {
        const double r = std::hypot(column - middle_x - shot.dx, row - middle_y - shot.dy);
        const double beside = 1.0 - 0.5 * std::erfc((r - radius_px) / (std::sqrt(2.0) * 0.9));
        const double level = out.at(column, row) + beside * (backdrop->levels.row(row)[column] - behind);
        out.at(column, row) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
      }
    }
    return out;
  };
  for (const auto& [dark, bright] : {std::pair{20.0, 60.0}, {150.0, 220.0}, {60.0, 200.0}}) {
    const Scene scene{dark, bright, behind, radius_px};
    TemplateSource source;
    source.region = {221, 139, 200, 200};
    source.margin_px = template_margin_px;
    source.pixels = crop(before_it(scene, {}), {209, 127, 224, 224});
    source.point = {100.3, 99.6};
    source.usable.assign(200 * 200, 1);
    source.backdrop = backdrop;
    const Eigen::Matrix2d blur = 0.25 * Eigen::Matrix2d::Identity();
    const auto rim = Rim::seen_in(completed(source), blur);
    ASSERT_TRUE(rim) << dark;
    EXPECT_NEAR(rim->circle().radius_px, radius_px, 0.15) << dark;
    EXPECT_LT(rim->middle_px().norm(), 0.1) << dark;
    const Shot moved{.dx = 4.3, .dy = -3.7, .lamp_x = 0.05, .lamp_y = -0.05, .seed = 5};
    const FramePatch patch(before_it(scene, moved), {201, 119, 240, 240}, blur);
    const auto there = rim->find(patch, {4.0, -4.0}, 1.0, Eigen::Matrix2d::Zero());
    ASSERT_TRUE(there) << dark;
    const Eigen::Vector2d off = there->moved_px - Eigen::Vector2d(moved.dx, moved.dy);
    EXPECT_LT(off.norm(), 0.1) << dark;
    EXPECT_LT(off.cwiseQuotient(there->covariance_px2.diagonal().cwiseSqrt()).cwiseAbs().maxCoeff(), 4.0) << dark;
  }
}

// Printed discs and rings are measured by all that they show: no rim, and none of its larger uncertainty.
TEST(Rim, IsNoneOfAPrint) {
  GrayImage rings{640, 480, std::vector<std::uint8_t>(640 * 480)};
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, 1.5);
  for (int row = 0; row < 480; ++row) {
    for (int column = 0; column < 640; ++column) {
      const double r = std::hypot(column - middle_x, row - middle_y);
      const double wave = r < 80.0 ? std::sin(r / 2.5) : 1.0;
      const double level = 120.0 + 80.0 * wave + noise(random);
      rings.pixels[static_cast<std::size_t>(row) * 640 + column] =
          static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L));
    }
  }
  TemplateSource source;
  source.region = {221, 139, 200, 200};
  source.margin_px = template_margin_px;
  source.pixels = crop(rings, {209, 127, 224, 224});
  source.point = {100.3, 99.6};
  source.usable.assign(200 * 200, 1);
  const Eigen::Matrix2d blur = 0.25 * Eigen::Matrix2d::Identity();
  EXPECT_FALSE(Rim::seen_in(completed(source), blur));
}

}  // namespace
}  // namespace zerodrift::vision
