// Round targets. A ball before what stands still shows little beside its outline, and what is reflected in it turns
// with the lamp.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "core/vision/target.h"
#include "tests/vision/speckle.h"

namespace zerodrift::vision {
namespace {

struct Ball {
  double dx = 0.0, dy = 0.0;
  double highlight_dx = 0.0, highlight_dy = 0.0;  // of what is reflected, within the ball
  unsigned seed = 1;
  double level = 28.0;
};

constexpr double radius_px = 70.0;
const Region around_ball{240, 160, 160, 160};

// Dark, with the reflection of a lamp and of a brighter floor, its outline blurred over two pixels.
GrayImage ball_before(const GrayImage& behind, const Ball& ball) {
  GrayImage out = behind;
  std::mt19937 random(ball.seed);
  std::normal_distribution<double> noise(0.0, 0.8);
  const double x0 = 319.7 + ball.dx, y0 = 239.4 + ball.dy;
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double shown = 0.5 * std::erfc((std::hypot(x - x0, y - y0) - radius_px) / (0.9 * M_SQRT2));
      const double lamp = std::hypot(x - x0 - 14.0 - ball.highlight_dx, y - y0 + 11.0 - ball.highlight_dy);
      const double own = ball.level + 0.2 * (y - y0) + 150.0 / (1.0 + std::exp((lamp - 6.0) / 1.5));
      const double level = shown * own + (1.0 - shown) * out.at(x, y) + noise(random);
      out.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0l, 255l));
    }
  }
  return out;
}

// Noise smoothed over some pixels, around 90 grey levels.
GrayImage rough_casting(double deviation = 14.0) {
  constexpr int width = 640, height = 480, reach = 3;
  std::mt19937 random(5);
  std::normal_distribution<double> noise;
  std::vector<double> levels(static_cast<std::size_t>(width) * height);
  for (double& one : levels) one = noise(random);
  for (const int step : {1, width, 1, width}) {  // along rows and columns, twice
    std::vector<double> sums(levels.size());
    for (std::size_t k = 0; k < levels.size(); ++k) {
      for (int n = -reach; n <= reach; ++n) sums[k] += levels[(k + levels.size() + n * step) % levels.size()];
    }
    levels = sums;
  }
  double squares = 0.0;
  for (const double one : levels) squares += one * one;
  const double scale = deviation / std::sqrt(squares / static_cast<double>(levels.size()));
  GrayImage out{width, height, std::vector<std::uint8_t>(levels.size())};
  for (std::size_t k = 0; k < levels.size(); ++k) {
    out.pixels[k] = static_cast<std::uint8_t>(std::clamp(std::lround(90.0 + scale * levels[k]), 0l, 255l));
  }
  return out;
}

std::vector<GrayImage> nine_views(const GrayImage& behind, double level = Ball().level) {
  std::vector<GrayImage> out;
  for (const double dx : {-60.0, 0.0, 60.0}) {
    for (const double dy : {-60.0, 0.0, 60.0}) {
      const auto seed = static_cast<unsigned>(100 + out.size());
      out.push_back(ball_before(behind, {.dx = dx, .dy = dy, .seed = seed, .level = level}));
    }
  }
  return out;
}

// Much of a view does not look like the template until what stands behind is known.
TEST(BallBeforeABackdrop, IsCalibratedAndMeasuredBeforeARoughOne) {
  const GrayImage behind = rough_casting();
  const auto plain = Target::create(ball_before(behind, {}), around_ball, {}, "t.png");
  ASSERT_TRUE(plain);
  const std::vector<GrayImage> views = nine_views(behind);
  const Target target = plain->learned_from(views);
  for (const GrayImage& view : views) EXPECT_TRUE(target.locate(view).ok);
  for (const auto& [dx, dy] : {std::pair{3.3, -2.1}, {-6.7, 5.2}, {0.4, 7.9}}) {
    const Location at = target.locate(ball_before(behind, {.dx = dx, .dy = dy, .seed = 7}));
    ASSERT_TRUE(at.ok) << at.reason;
    EXPECT_NEAR(at.x_px, dx, 0.05);
    EXPECT_NEAR(at.y_px, dy, 0.05);
  }
}

// Hardly a view is measured before what stands behind is known, and all teach it.
TEST(BallBeforeABackdrop, IsMeasuredWhereItIsNearlyAsBrightAsThat) {
  constexpr double level = 56.0;
  const GrayImage behind = rough_casting(20.0);
  const auto plain = Target::create(ball_before(behind, {.level = level}), around_ball, {}, "t.png");
  ASSERT_TRUE(plain);
  const std::vector<GrayImage> views = nine_views(behind, level);
  const Target target = plain->learned_from(views);
  int measured = 0;
  for (const GrayImage& view : views) measured += target.locate(view).ok;
  EXPECT_GE(measured, 7);
  const Location at = target.locate(ball_before(behind, {.dx = 3.3, .dy = -2.1, .seed = 7, .level = level}));
  ASSERT_TRUE(at.ok) << at.reason;
  EXPECT_NEAR(at.x_px, 3.3, 4.0 * at.sigma_x_px);
  EXPECT_NEAR(at.y_px, -2.1, 4.0 * at.sigma_y_px);
  EXPECT_LT(std::max(at.sigma_x_px, at.sigma_y_px), 0.1);
}

// Nothing can be learned of a backdrop without texture; what turns with the lamp must not move the ball all the same.
TEST(BallBeforeABackdrop, ATurnedLampDoesNotMoveItBeforeAnEvenOne) {
  const GrayImage behind{640, 480, std::vector<std::uint8_t>(640 * 480, 150)};
  const auto plain = Target::create(ball_before(behind, {}), around_ball, {}, "t.png");
  ASSERT_TRUE(plain);
  const Target target = plain->learned_from(nine_views(behind));
  double squares = 0.0;
  int count = 0;
  for (const double moved : {0.3, 1.0, 2.0, 4.0}) {
    for (const double angle : {0.4, 2.5, 4.6}) {
      const Ball ball{.dx = 2.3,
                      .dy = -1.6,
                      .highlight_dx = moved * std::cos(angle),
                      .highlight_dy = moved * std::sin(angle),
                      .seed = 9};
      const Location at = target.locate(ball_before(behind, ball));
      ASSERT_TRUE(at.ok) << at.reason << " at " << moved;
      EXPECT_NEAR(at.x_px, 2.3, 0.015) << moved << " " << angle;
      EXPECT_NEAR(at.y_px, -1.6, 0.015) << moved << " " << angle;
      squares += std::pow((at.x_px - 2.3) / at.sigma_x_px, 2) + std::pow((at.y_px + 1.6) / at.sigma_y_px, 2);
      count += 2;
    }
  }
  EXPECT_LT(std::sqrt(squares / count), 2.0);
}

// What is printed on a disc does turn with it, and moves a named point beside the middle.
TEST(BallBeforeABackdrop, ATurnOfAPrintedDiscIsNoReflection) {
  const testing::Speckle print(51, 320.0, 240.0, 85.0);
  const auto disc = [&](double dx, double dy, double turn_rad, unsigned seed) {
    const testing::Pose pose{.dx = dx, .dy = dy, .rotation_rad = turn_rad};
    GrayImage out = testing::render(print, pose, {.noise = 0.8, .seed = seed});
    for (int y = 0; y < out.height; ++y) {
      for (int x = 0; x < out.width; ++x) {
        const double shown =
            0.5 * std::erfc((std::hypot(x - 320.0 - dx, y - 240.0 - dy) - radius_px) / (0.9 * M_SQRT2));
        out.at(x, y) = static_cast<std::uint8_t>(std::lround(shown * out.at(x, y) + (1.0 - shown) * 40.0));
      }
    }
    return out;
  };
  const auto target = Target::create(disc(0.0, 0.0, 0.0, 1), around_ball, PixelPoint{365.0, 210.0}, "t.png");
  ASSERT_TRUE(target);
  for (const double turn_rad : {-0.012, 0.0, 0.004, 0.015}) {
    const Location at = target->locate(disc(2.7, -1.4, turn_rad, 5));
    ASSERT_TRUE(at.ok) << at.reason;
    const double c = std::cos(turn_rad) - 1.0, s = std::sin(turn_rad);
    EXPECT_NEAR(at.x_px, 2.7 + c * 45.0 + s * 30.0, 0.015) << turn_rad;
    EXPECT_NEAR(at.y_px, -1.4 + s * 45.0 - c * 30.0, 0.015) << turn_rad;
  }
}

// Rings three times as bright and dark around as within, 12 px from one to the next.
GrayImage rings(double dx, double dy, unsigned seed) {
  GrayImage out{640, 480, std::vector<std::uint8_t>(640 * 480)};
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 2.0);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double r = std::hypot(x - 319.7 - dx, y - 239.4 - dy);
      const double shown = 0.5 * std::erfc((r - 72.0) / 1.3);
      const double level = 120.0 + shown * 60.0 * std::sin(2.0 * M_PI * r / 12.0) + noise(random);
      out.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0l, 255l));
    }
  }
  return out;
}

// What noise seems to tell of a turn moves a point beside the middle and must not be called known.
TEST(Rings, DoNotTellHowFarTheyHaveTurned) {
  constexpr double beside_px = 30.0, turn = 0.004;
  double squares = 0.0, largest_px = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const GrayImage shown = rings(0.0, 0.0, seed);
    const auto middle = Target::create(shown, around_ball, PixelPoint{319.7, 239.4}, "t.png");
    const auto beside = Target::create(shown, around_ball, PixelPoint{319.7, 239.4 - beside_px}, "t.png");
    ASSERT_TRUE(middle && beside);
    for (const double dx : {0.3, -4.6}) {
      const GrayImage frame = rings(dx, 2.2, 100 + seed);
      const Location known = middle->locate(frame);
      ASSERT_TRUE(known.ok) << known.reason;
      EXPECT_NEAR(known.x_px, dx, 4.0 * known.sigma_x_px);
      EXPECT_LT(known.sigma_x_px, 0.01);
      const Location unknown = beside->locate(frame);
      ASSERT_TRUE(unknown.ok) << unknown.reason;
      // The frame is the same whether the rings have turned or not.
      for (const double turned : {0.0, turn, -turn}) {
        squares += std::pow((unknown.x_px - dx - turned * beside_px) / unknown.sigma_x_px, 2);
        ++count;
      }
      largest_px = std::max(largest_px, std::abs(unknown.x_px - dx));
    }
  }
  const double ratio = std::sqrt(squares / count);
  EXPECT_GT(ratio, 0.3);
  EXPECT_LT(ratio, 1.5);
  EXPECT_LT(largest_px, 0.02);  // a turn that is not there
}

}  // namespace
}  // namespace zerodrift::vision
