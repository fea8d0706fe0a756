// A mark that moves within a printed frame that does not: of a region that holds both a registration may follow either.

#include "core/vision/moved_apart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "core/vision/target.h"

namespace zerodrift::vision {
namespace {

constexpr double stands_x = 318.3, stands_y = 243.6, edge_blur_px = 0.9;

struct MarkPlace {
  double x = 0.0, y = 0.0, size = 1.0;
};

double share_of(double at, double half) {
  return 0.5 * (std::erf((at + half) / (edge_blur_px * M_SQRT2)) - std::erf((at - half) / (edge_blur_px * M_SQRT2)));
}

double small_cross(double x, double y) {
  const double along = share_of(x, 35.0) * share_of(y, 3.0), down = share_of(x, 3.0) * share_of(y, 35.0);
  return along + down - share_of(x, 3.0) * share_of(y, 3.0);
}

// A tenth of what the frame shows.
double tiny_cross(double x, double y) {
  const double along = share_of(x, 12.0) * share_of(y, 2.0), down = share_of(x, 2.0) * share_of(y, 12.0);
  return along + down - share_of(x, 2.0) * share_of(y, 2.0);
}

double dots_at(double x, double y) {
  double out = 0.0;
  for (int row = -2; row <= 2; ++row) {
    for (int column = -2; column <= 2; ++column) {
      out += share_of(x - 14.0 * column, 4.0) * share_of(y - 14.0 * row, row == 0 && column == 0 ? 6.0 : 4.0);
    }
  }
  return out;
}

double frame_around(double x, double y) {
  return share_of(x, 52.0) * share_of(y, 52.0) - share_of(x, 46.0) * share_of(y, 46.0);
}

// They hold a registration along x, and at their ends alone along y.
double bars_beside(double x, double y) {
  double out = 0.0;
  for (const double at : {44.0, 51.0}) out += (share_of(x - at, 1.5) + share_of(x + at, 1.5)) * share_of(y, 50.0);
  return out;
}

using Mark = double (*)(double x, double y);

GrayImage framed(Mark mark, const MarkPlace& mark_at, const MarkPlace& frame_at, unsigned seed,
                 Mark around = &frame_around) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.5);
  GrayImage out{640, 480, std::vector<std::uint8_t>(640 * 480)};
  for (int row = 0; row < out.height; ++row) {
    for (int column = 0; column < out.width; ++column) {
      const double x = column - stands_x, y = row - stands_y;
      const double fx = (x - frame_at.x) / frame_at.size, fy = (y - frame_at.y) / frame_at.size;
      double ink = around(fx, fy);
      ink += mark((x - mark_at.x) / mark_at.size, (y - mark_at.y) / mark_at.size);
      out.at(column, row) =
          static_cast<std::uint8_t>(std::clamp(std::lround(170.0 - 120.0 * ink + noise(random)), 0L, 255L));
    }
  }
  return out;
}

class MarkInAFrame : public ::testing::TestWithParam<Mark> {
 protected:
  Target target() const {
    auto made =
        Target::create(framed(GetParam(), {}, {}, 1), {254, 180, 128, 128}, PixelPoint{stands_x, stands_y}, "mark.png");
    EXPECT_TRUE(made) << "no target";
    return *made;
  }
};

TEST_P(MarkInAFrame, IsRefusedWhereItMovesAlone) {
  const Target seen = target();
  unsigned seed = 10;
  for (const double way_px : {0.25, 0.5, 0.8, 1.5, 3.0, 6.0}) {
    for (int k = 0; k < 3; ++k) {
      const MarkPlace moved{way_px * std::cos(2.1 * k + way_px), way_px * std::sin(2.1 * k + way_px)};
      const Location at = seen.locate(framed(GetParam(), moved, {}, seed++));
      EXPECT_FALSE(at.ok && std::hypot(at.x_px - moved.x, at.y_px - moved.y) > 0.1) << way_px << " " << k;
    }
  }
}

TEST_P(MarkInAFrame, IsMeasuredWhereBothMove) {
  const Target seen = target();
  for (unsigned k = 0; k < 4; ++k) {
    const MarkPlace moved{5.3 * std::cos(2.1 * k), 4.1 * std::sin(1.7 * k + 0.4)};
    const Location at = seen.locate(framed(GetParam(), moved, moved, 40 + k));
    ASSERT_TRUE(at.ok) << k << " " << at.reason;
    EXPECT_LT(std::hypot(at.x_px - moved.x, at.y_px - moved.y), 0.02) << k;
  }
}

// What is calibrated shows it in one size; a body that warms grows by less than 0.001.
TEST_P(MarkInAFrame, IsAnotherTargetInAnotherSize) {
  const Target seen = target();
  for (const double size : {0.98, 0.988, 1.012, 1.02}) {
    EXPECT_FALSE(seen.locate(framed(GetParam(), {1.2, -2.1, size}, {1.2, -2.1, size}, 50)).ok) << size;
  }
  for (const double size : {0.998, 1.002}) {
    EXPECT_TRUE(seen.locate(framed(GetParam(), {1.2, -2.1, size}, {1.2, -2.1, size}, 51)).ok) << size;
  }
}

// Frames in which it moves teach that the bars do not, although each by itself is found by the bars.
TEST(MarkBetweenBars, IsRefusedOrMeasuredWhereItIs) {
  auto made = Target::create(framed(&dots_at, {}, {}, 1, &bars_beside), {254, 180, 128, 128},
                             PixelPoint{stands_x, stands_y}, "mark.png");
  ASSERT_TRUE(made);
  std::vector<GrayImage> frames;
  std::vector<MarkPlace> places;
  for (const double way_px : {0.3, 0.6, 1.2, 2.5, 3.5, 5.0}) {
    for (int k = 0; k < 2; ++k) {
      places.push_back({way_px * std::cos(1.9 * k + way_px), way_px * std::sin(1.9 * k + way_px)});
      frames.push_back(framed(&dots_at, places.back(), {}, 60 + static_cast<unsigned>(frames.size()), &bars_beside));
    }
  }
  const auto error_of = [&](const Location& at, std::size_t k) {
    return std::hypot(at.x_px - places[k].x, at.y_px - places[k].y);
  };
  const Target taught = made->learned_from(frames);
  int measured = 0;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const Location alone = made->locate(frames[k]);
    EXPECT_FALSE(alone.ok && error_of(alone, k) > 0.1) << k << ": " << error_of(alone, k);
    const Location at = taught.locate(frames[k]);
    measured += at.ok;
    EXPECT_FALSE(at.ok && error_of(at, k) > 0.02) << k << ": " << error_of(at, k);
  }
  EXPECT_GE(measured, 6);
}

INSTANTIATE_TEST_SUITE_P(Marks, MarkInAFrame, ::testing::Values(&small_cross, &tiny_cross, &dots_at));

}  // namespace
}  // namespace zerodrift::vision
