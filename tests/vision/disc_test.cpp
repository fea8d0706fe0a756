// Round targets of the level of what stands behind them, whose structure is more than theirs: a registration may follow
// what stands still. And round targets of another size than the template's.

#include "core/vision/disc.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/vision/target.h"

namespace zerodrift::vision {
namespace {

constexpr double named_x = 320.4, named_y = 241.2, usual_radius_px = 84.0;

struct Round {
  double x, y;
  double radius = usual_radius_px;
};

// Stripes, clouds, or nothing behind balls that are shaded by little; edges blurred by 0.9 px, noise of 2 grey levels.
enum class Behind { stripes, clouds, even };

GrayImage picture(Behind behind, const std::vector<Round>& balls, unsigned seed) {
  struct Wave {
    double x, y, phase, size;
  };
  std::mt19937 same(7);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  std::vector<Wave> waves;
  for (int k = 0; k < 60; ++k) {
    const double period_px = 8.0 * std::pow(1.06, k);
    const double turn = M_PI * any(same);
    waves.push_back({2 * M_PI * std::cos(turn) / period_px, 2 * M_PI * std::sin(turn) / period_px, M_PI * any(same),
                     1.2 * std::sqrt(period_px / 8.0)});
  }
  GrayImage out{640, 480, std::vector<std::uint8_t>(640 * 480)};
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 2.0);
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      double level = 120.0;
      if (behind == Behind::stripes)
        level += 14.0 * std::tanh(4.0 * std::sin((column + 0.5 * row) * 2.0 * M_PI / 41.0));
      if (behind == Behind::clouds) {
        for (const Wave& one : waves) level += one.size * std::sin(one.x * column + one.y * row + one.phase);
      }
      for (const Round& one : balls) {
        const double x = (column - one.x) / one.radius, y = (row - one.y) / one.radius;
        const double r = std::hypot(x, y);
        const double inside = 0.5 * std::erfc((r - 1.0) * one.radius / (std::sqrt(2.0) * 0.9));
        const double glint = 80.0 * std::exp(-(std::pow(x + 0.1, 2) + std::pow(y + 0.2, 2)) / 0.008);
        level += inside * (138.0 - 12.0 * r * r + 6.0 * x + glint - level);
      }
      out.pixels[static_cast<std::size_t>(row) * 640 + column] =
          static_cast<std::uint8_t>(std::clamp(std::lround(level + noise(random)), 0L, 255L));
    }
  }
  return out;
}

Target target_of(const GrayImage& image, const Region& around) {
  auto made = Target::create(image, around, PixelPoint{named_x, named_y}, "ball.png");
  EXPECT_TRUE(made) << "no target";
  return *made;
}

class BeforeWhatStands : public ::testing::TestWithParam<Behind> {};

TEST_P(BeforeWhatStands, IsMeasuredOrRefused) {
  const Behind behind = GetParam();
  const Target alone = target_of(picture(behind, {{named_x, named_y}}, 1), {222, 143, 196, 196});
  std::vector<GrayImage> frames;
  std::vector<Round> truth;
  for (unsigned k = 0; k < 8; ++k) {
    truth.push_back({named_x + 4.7 * std::cos(1.9 * k), named_y + 4.1 * std::sin(1.3 * k + 0.4)});
    frames.push_back(picture(behind, {truth.back()}, 10 + k));
  }
  for (const Target& target : {alone, alone.learned_from(frames, Cover::possible)}) {
    for (std::size_t k = 0; k < frames.size(); ++k) {
      const Location at = target.locate(frames[k]);
      if (!at.ok) continue;
      EXPECT_LT(std::hypot(at.x_px + named_x - truth[k].x, at.y_px + named_y - truth[k].y), 0.5) << k;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, BeforeWhatStands, ::testing::Values(Behind::stripes, Behind::clouds));

TEST(Disc, OfAnotherSizeIsAnotherTarget) {
  const Target target = target_of(picture(Behind::even, {{named_x, named_y}}, 1), {222, 143, 196, 196});
  for (const double size : {0.95, 0.97, 1.03, 1.05}) {
    const Location at =
        target.locate(picture(Behind::even, {{named_x + 1.3, named_y - 2.2, size * usual_radius_px}}, 2));
    EXPECT_FALSE(at.ok) << size;
  }
  for (unsigned seed = 1; seed < 4; ++seed) {
    EXPECT_TRUE(target.locate(picture(Behind::even, {{named_x + 1.3, named_y - 2.2}}, seed)).ok);
  }
}

// Printed rings and discs of 70 levels.
struct Print {
  double x, y, radius;
  double hole = 0.0;  // px, of a ring its inner radius
};

GrayImage printed(const std::vector<Print>& prints, unsigned seed) {
  GrayImage out = picture(Behind::even, {}, seed);
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      double ink = 0.0;
      for (const Print& one : prints) {
        const double r = std::hypot(column - one.x, row - one.y);
        const auto within = [&](double radius) { return 0.5 * std::erfc((r - radius) / (std::sqrt(2.0) * 0.9)); };
        ink += within(one.radius) - (one.hole > 0.0 ? within(one.hole) : 0.0);
      }
      std::uint8_t& level = out.pixels[static_cast<std::size_t>(row) * 640 + column];
      level = static_cast<std::uint8_t>(std::clamp(std::lround(level - 70.0 * ink), 0L, 255L));
    }
  }
  return out;
}

TEST(Disc, ThatMovesWithinWhatStandsIsNotTakenForIt) {
  const Print ring{named_x, named_y, 55.0, 48.0};
  const Target target = target_of(printed({{named_x, named_y, 30.0}, ring}, 1), {258, 179, 124, 124});
  EXPECT_TRUE(target.locate(printed({{named_x, named_y, 30.0}, ring}, 2)).ok);
  for (unsigned k = 0; k < 6; ++k) {
    const double dx = 4.9 * std::cos(2.1 * k), dy = 4.3 * std::sin(1.7 * k + 0.3);
    const Location at = target.locate(printed({{named_x + dx, named_y + dy, 30.0}, ring}, 20 + k));
    if (at.ok) {
      EXPECT_LT(std::hypot(at.x_px - dx, at.y_px - dy), 0.2) << k;
    }
  }
}

TEST(Disc, ThatMovesByLittleWithinARingThatStandsIsNotTakenForIt) {
  const Print ring{named_x, named_y, 62.0, 45.0};
  const Target target = target_of(printed({{named_x, named_y, 28.0}, ring}, 1), {250, 171, 140, 140});
  for (unsigned k = 0; k < 6; ++k) {
    const double dx = 0.7 * std::cos(2.1 * k), dy = 0.6 * std::sin(1.7 * k + 0.3);
    const Location at = target.locate(printed({{named_x + dx, named_y + dy, 28.0}, ring}, 40 + k));
    EXPECT_FALSE(at.ok && std::hypot(at.x_px - dx, at.y_px - dy) > 0.1) << k;
  }
}

TEST(Disc, IsNotTakenForItsTwinBesideTheRegion) {
  const Print twin{named_x + 85.0, named_y, 30.0};
  const Target target = target_of(printed({{named_x, named_y, 30.0}, twin}, 1), {276, 197, 90, 90});
  for (unsigned k = 0; k < 8; ++k) {
    const double dx = 3.9 * std::cos(2.1 * k), dy = 3.3 * std::sin(1.7 * k + 0.3);
    const Location at = target.locate(printed({{named_x + dx, named_y + dy, 30.0}, twin}, 30 + k));
    ASSERT_TRUE(at.ok) << k << " " << at.reason;
    EXPECT_LT(std::hypot(at.x_px - dx, at.y_px - dy), 0.2) << k;
  }
}

TEST(Disc, IsTheOneThatIsNamed) {
  const Round other{named_x + 150.0, named_y + 12.0, 50.0};
  const Target target = target_of(picture(Behind::even, {{named_x, named_y}, other}, 1), {222, 143, 310, 196});
  for (unsigned k = 0; k < 6; ++k) {
    const double dx = 3.9 * std::cos(2.1 * k), dy = 3.3 * std::sin(1.7 * k + 0.3);
    const Location at = target.locate(picture(Behind::even, {{named_x + dx, named_y + dy}, other}, 20 + k));
    if (at.ok) {
      EXPECT_LT(std::hypot(at.x_px - dx, at.y_px - dy), 0.2) << k;
    }
  }
}

}  // namespace
}  // namespace zerodrift::vision
