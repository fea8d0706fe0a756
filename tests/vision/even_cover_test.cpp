// An even cover about as bright as what stands behind the target: light that falls to nothing over it would explain it,
// and so would what is known to stand behind.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "core/vision/target.h"

namespace zerodrift::vision {
namespace {

constexpr int picture_width = 320;
constexpr int picture_height = 240;
constexpr double middle_x = 160.0;
constexpr double middle_y = 120.0;
const Region face_region{79, 39, 164, 164};

struct EvenCover {
  double towards_rad = 0.0;
  double from_middle_px = 1e3;  // of the target: there its straight edge is
  double level = 0.0;
};

double backdrop_at(double x, double y) {
  return 70.0 + 8.0 * std::sin(y / 13.0) + 6.0 * std::sin(x / 17.0 + y / 29.0);
}

// A turned face with its grooves, their sheen, a hole, a slot and a bright rim.
double scene_at(double x, double y, double dx, double dy) {
  const double u = x - middle_x - dx;
  const double v = y - middle_y - dy;
  const double radius = std::hypot(u, v);
  if (radius >= 75.0) return backdrop_at(x, y);
  if (radius > 71.0) return 150.0;
  if (radius < 12.0) return 35.0;
  if (std::abs(u + 0.3 * v) < 6.0 && v > 0.0 && v < 52.0) return 30.0;
  const double sheen = 1.0 + 0.45 * std::cos(2.0 * (std::atan2(v, u) - 0.6));
  return 95.0 * sheen + (14.0 + 6.0 * sheen) * std::sin(radius * 2.0 * std::numbers::pi / 4.2);
}

std::vector<double> blurred_along(const std::vector<double>& from, int step, int length, double sigma_px) {
  std::vector<double> out(from.size());
  for (std::size_t k = 0; k < from.size(); ++k) {
    const int at = static_cast<int>(k) / step % length;
    double sum = 0.0, weights = 0.0;
    for (int away = -4; away <= 4; ++away) {
      const double weight = std::exp(-0.5 * away * away / (sigma_px * sigma_px));
      const int there = std::clamp(at + away, 0, length - 1) - at;
      sum += weight * from[static_cast<std::size_t>(static_cast<int>(k) + there * step)];
      weights += weight;
    }
    out[k] = sum / weights;
  }
  return out;
}

GrayImage face(double dx, double dy, unsigned seed, const EvenCover& cover = {}) {
  constexpr int parts = 3;
  std::vector<double> levels(static_cast<std::size_t>(picture_width) * picture_height);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const int x = static_cast<int>(k) % picture_width;
    const int y = static_cast<int>(k) / picture_width;
    for (int part = 0; part < parts * parts; ++part) {
      const double right = (part % parts + 0.5) / parts - 0.5;
      const double below = (part / parts + 0.5) / parts - 0.5;
      levels[k] += scene_at(x + right, y + below, dx, dy) / (parts * parts);
    }
  }
  levels = blurred_along(levels, 1, picture_width, 0.9);
  levels = blurred_along(levels, picture_width, picture_height, 0.9);
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  GrayImage out{picture_width, picture_height, {}};
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double x = static_cast<double>(k % picture_width) - middle_x - dx;
    const double y = static_cast<double>(k / picture_width) - middle_y - dy;
    const double beyond = x * std::cos(cover.towards_rad) + y * std::sin(cover.towards_rad) - cover.from_middle_px;
    const double hidden = std::clamp(beyond / 2.0 + 0.5, 0.0, 1.0);
    const double level = levels[k] + hidden * (cover.level - levels[k]) + noise(random);
    out.pixels.push_back(static_cast<std::uint8_t>(std::clamp(std::lround(level), 0L, 255L)));
  }
  return out;
}

/// How many of 24 frames are measured; each that is must be right.
int measured_under_covers(const Target& target) {
  constexpr double dx = 4.3, dy = -2.6;
  int measured = 0;
  for (int k = 0; k < 24; ++k) {
    const EvenCover cover{k * std::numbers::pi / 4.0 + 0.2, 30.0 - 10.0 * (k / 8),
                          k % 3 == 0 ? 40.0 : 45.0 + 15.0 * (k % 3)};
    const Location at = target.locate(face(dx, dy, 50u + static_cast<unsigned>(k), cover));
    if (!at.ok) continue;
    ++measured;
    EXPECT_NEAR(at.x_px, dx, 5.0 * at.sigma_x_px) << k;
    EXPECT_NEAR(at.y_px, dy, 5.0 * at.sigma_y_px) << k;
    EXPECT_NEAR(std::hypot(at.x_px - dx, at.y_px - dy), 0.0, 0.1) << k;
  }
  return measured;
}

Target face_at_rest() {
  return *Target::create(face(0.0, 0.0, 1), face_region, PixelPoint{middle_x, middle_y}, "template.png");
}

TEST(EvenCover, AsBrightAsWhatIsKnownToStandBehindIsNoTarget) {
  std::vector<GrayImage> views;
  for (int k = 0; k < 9; ++k)
    views.push_back(face(9.0 * (k / 3 - 1), 9.0 * (k % 3 - 1), 2u + static_cast<unsigned>(k)));
  const Target target = face_at_rest().learned_from(views);
  ASSERT_TRUE(target.backdrop());
  EXPECT_GE(measured_under_covers(target), 12);
}

TEST(EvenCover, IsNoChangeOfLight) {
  measured_under_covers(face_at_rest());
}

// Covers that hide the same part in each frame, each a little differently, are no part of the target that stands still,
// and what is as bright as they are does not stand behind it.
TEST(EvenCover, TeachesNothingOfTheTarget) {
  std::vector<GrayImage> frames;
  for (int k = 0; k < 9; ++k) {
    const EvenCover cover{0.15 * (k % 3 - 1), 30.0 + k, 40.0 + 5.0 * k};
    frames.push_back(face(6.0 * (k / 3 - 1), 6.0 * (k % 3 - 1), 90u + static_cast<unsigned>(k), cover));
  }
  const Target target = face_at_rest();
  EXPECT_NE(target.learned_from(frames).mask(), target.mask());
  const Target taught = target.learned_from(frames, Cover::possible);
  EXPECT_EQ(taught.mask(), target.mask());
  EXPECT_FALSE(taught.backdrop());
}

// A lamp that has moved lights one side half as much again as the other: that is no cover.
TEST(EvenCover, AStrongSlopeOfLightIsNoCover) {
  const Target target = face_at_rest();
  GrayImage frame = face(4.3, -2.6, 3);
  for (std::size_t k = 0; k < frame.pixels.size(); ++k) {
    const double x = static_cast<double>(k % picture_width);
    frame.pixels[k] = static_cast<std::uint8_t>(std::lround(frame.pixels[k] * (0.8 + 0.0025 * (x - middle_x))));
  }
  const Location at = target.locate(frame);
  ASSERT_TRUE(at.ok) << at.reason;
  EXPECT_NEAR(at.x_px, 4.3, std::max(0.005, 5.0 * at.sigma_x_px));
  EXPECT_NEAR(at.y_px, -2.6, std::max(0.005, 5.0 * at.sigma_y_px));
}

}  // namespace
}  // namespace zerodrift::vision
