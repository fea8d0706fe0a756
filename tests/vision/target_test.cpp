#include "core/vision/target.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <random>

#include "tests/vision/speckle.h"

namespace zerodrift::vision {
namespace {

using testing::Light;
using testing::Pose;
using testing::render;
using testing::Speckle;

const Region target_region{240, 160, 160, 160};

Target target_of(const Speckle& speckle, double noise = 0.0, std::optional<PixelPoint> point = std::nullopt) {
  auto target = Target::create(render(speckle, {}, {.noise = noise, .seed = 99}), target_region, point, "template.png");
  EXPECT_TRUE(target) << describe(target.error());
  return *target;
}

TEST(Target, FindsShiftsToAThousandthOfAPixel) {
  const Speckle speckle(1);
  const Target target = target_of(speckle);
  for (const auto& [dx, dy] :
       std::vector<std::pair<double, double>>{{0, 0}, {0.37, -0.61}, {3.25, 1.5}, {-37.3, 24.8}, {52.5, -41.25}}) {
    const Location at = target.locate(render(speckle, {.dx = dx, .dy = dy}));
    ASSERT_TRUE(at.ok) << at.reason;
    EXPECT_NEAR(at.x_px, dx, 0.001);
    EXPECT_NEAR(at.y_px, dy, 0.001);
    const bool far = std::hypot(dx, dy) > 10.0;  // the lens is not known before, and the frame is rounded
    EXPECT_LT(at.sigma_x_px, far ? 0.0012 : 0.001);
    EXPECT_LT(std::abs(at.x_px - dx), 3.0 * at.sigma_x_px);
    EXPECT_LT(std::abs(at.y_px - dy), 3.0 * at.sigma_y_px);
  }
}

TEST(Target, NoiseLightBlurAndRotationAreNotTakenForMotion) {
  const Speckle speckle(2);
  const Target target = target_of(speckle, 2.0);
  const std::vector<std::pair<Pose, Light>> cases{
      {{.dx = 1.3, .dy = -2.2}, {.noise = 2.0, .seed = 3}},
      {{.dx = 1.3, .dy = -2.2}, {.gain = 0.7, .offset = 20, .slope_x = 0.3, .noise = 1.0, .seed = 4}},
      {{.dx = 1.3, .dy = -2.2}, {.noise = 1.0, .blur_px = 1.5, .seed = 5}},
      {{.dx = 1.3, .dy = -2.2, .rotation_rad = 0.015, .pivot_x = 319.5, .pivot_y = 239.5}, {.noise = 1.0, .seed = 6}}};
  for (const auto& [pose, light] : cases) {
    const Location at = target.locate(render(speckle, pose, light));
    ASSERT_TRUE(at.ok) << at.reason;
    EXPECT_NEAR(at.x_px, pose.dx, 3.5 * at.sigma_x_px);
    EXPECT_NEAR(at.y_px, pose.dy, 3.5 * at.sigma_y_px);
    EXPECT_LT(at.sigma_x_px, 0.012);
    EXPECT_LT(at.sigma_y_px, 0.012);
  }
}

TEST(Target, ReportsTheNamedPointUnderRotation) {
  const Speckle speckle(3);
  const PixelPoint point{400.0, 239.5};
  const Target target = target_of(speckle, 1.0, point);
  const double angle = 0.01;
  const Location at =
      target.locate(render(speckle, {.rotation_rad = angle, .pivot_x = 319.5, .pivot_y = 239.5}, {.noise = 1.0}));
  ASSERT_TRUE(at.ok);
  EXPECT_NEAR(at.x_px, 80.5 * (std::cos(angle) - 1.0), 3.5 * at.sigma_x_px);
  EXPECT_NEAR(at.y_px, 80.5 * std::sin(angle), 3.5 * at.sigma_y_px);
  EXPECT_LT(at.sigma_y_px, 0.02);
}

/// A grid of 6 x 6 dots, 24 px apart, in the middle of the target's region.
Speckle grid() {
  Speckle dots(1);
  dots.dots.clear();
  for (int row = 0; row < 6; ++row) {
    for (int column = 0; column < 6; ++column) {
      dots.dots.push_back({260.0 + 24.0 * column, 180.0 + 24.0 * row, 4.0, 110.0});
    }
  }
  return dots;
}

void paint(GrayImage& image, const Region& where, std::uint8_t level) {
  for (int y = where.y; y < where.y + where.height; ++y) {
    for (int x = where.x; x < where.x + where.width; ++x) image.at(x, y) = level;
  }
}

// Under an even cover over its first column a grid may as well stand a period further; a lamp's spot within it hides
// as much but leaves its ends to be seen.
TEST(Target, APatternThatRepeatsIsNotTakenForItselfAPeriodFurther) {
  const Target target = target_of(grid(), 1.0);
  const Pose moved{.dx = 3.3, .dy = -2.1};
  const GrayImage whole = render(grid(), moved, {.noise = 1.0, .seed = 7});
  const Location seen = target.locate(whole);
  ASSERT_TRUE(seen.ok) << seen.reason;
  EXPECT_NEAR(seen.x_px, moved.dx, 4.0 * seen.sigma_x_px);
  EXPECT_NEAR(seen.y_px, moved.dy, 4.0 * seen.sigma_y_px);

  GrayImage covered = whole;
  paint(covered, {230, 150, 48, 190}, 190);
  const Location doubted = target.locate(covered);
  EXPECT_FALSE(doubted.ok) << doubted.x_px << ' ' << doubted.y_px;
  EXPECT_EQ(doubted.refusal, Refusal::ambiguous) << doubted.reason;

  GrayImage glare = whole;
  paint(glare, {297, 217, 48, 48}, 255);
  const Location beside = target.locate(glare);
  ASSERT_TRUE(beside.ok) << beside.reason;
  EXPECT_NEAR(beside.x_px, moved.dx, 4.0 * beside.sigma_x_px);
  EXPECT_NEAR(beside.y_px, moved.dy, 4.0 * beside.sigma_y_px);
}

/// Dots 24 px apart over `left` .. `right`, one row higher than wide, but for those in `missing`.
Speckle lattice(int left, int right, const std::vector<std::array<int, 2>>& missing = {}) {
  Speckle dots(1);
  dots.dots.clear();
  for (int y = 20; y <= 460; y += 24) {
    for (int x = left; x <= right; x += 24) {
      const bool gone = std::any_of(missing.begin(), missing.end(),
                                    [&](const std::array<int, 2>& one) { return one[0] == x && one[1] == y; });
      if (!gone) dots.dots.push_back({double(x), double(y), 4.0, 110.0});
    }
  }
  return dots;
}

// What goes on beyond the region and repeats itself is told by its end, if the picture shows one.
TEST(Target, ARegionWithinAPatternThatRepeatsIsMadeLarger) {
  const auto endless = Target::create(render(lattice(-4, 644)), target_region, {}, "plate.png");
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().code, ErrorCode::pattern_repeats);

  Speckle plate = lattice(224, 416);
  std::erase_if(plate.dots, [](const auto& dot) { return dot.y < 140.0 || dot.y > 340.0; });
  const auto target = Target::create(render(plate), target_region, {}, "plate.png");
  ASSERT_TRUE(target);
  EXPECT_GT(target->region().width, target_region.width);
  EXPECT_EQ(target->point().x_px, centre_of(target_region).x_px);
  for (const Pose& moved : {Pose{.dx = 24.3, .dy = 1.2}, Pose{.dx = -3.4, .dy = -24.0}, Pose{.dx = 0.4, .dy = 0.3}}) {
    const Location at = target->locate(render(plate, moved, {.noise = 1.0, .seed = 3}));
    ASSERT_TRUE(at.ok) << at.reason;
    EXPECT_NEAR(at.x_px, moved.dx, 0.02);
    EXPECT_NEAR(at.y_px, moved.dy, 0.02);
  }
}

/// A knurled face: its squares stand on their corners, 11 px from one to the next; even beyond `half_side_px`.
GrayImage knurl(double dx, double dy, double half_side_px, unsigned seed) {
  GrayImage out{640, 480, std::vector<std::uint8_t>(640 * 480)};
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, 1.0);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double across = x - 320.0 - dx, down = y - 240.0 - dy;
      const auto within = [&](double at) { return 0.5 * std::erfc((std::abs(at) - half_side_px) / 1.2); };
      const double wave = std::sin(2.0 * M_PI * (across + down) / 11.3) * std::sin(2.0 * M_PI * (across - down) / 11.3);
      const double level = 120.0 + 40.0 * wave * within(across) * within(down) + noise(random);
      out.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::lround(level), 0l, 255l));
    }
  }
  return out;
}

// Seen as a whole, what repeats every few pixels is a grey face: nothing was known of it, and it was found periods off.
TEST(Target, AFinePatternThatRepeatsIsRefusedOrFoundWhereItIs) {
  const auto endless = Target::create(knurl(0.0, 0.0, 900.0, 1), target_region, {}, "knurl.png");
  ASSERT_FALSE(endless);
  EXPECT_EQ(endless.error().code, ErrorCode::pattern_repeats);
  const auto target = Target::create(knurl(0.0, 0.0, 145.0, 1), target_region, {}, "patch.png");
  ASSERT_TRUE(target);
  for (const auto& [dx, dy] : {std::pair{0.0, 0.0}, {2.3, -1.7}, {-6.4, 4.9}, {11.2, 3.6}}) {
    const Location at = target->locate(knurl(dx, dy, 145.0, 2));
    ASSERT_TRUE(at.ok) << at.reason;
    EXPECT_NEAR(at.x_px, dx, 0.01);
    EXPECT_NEAR(at.y_px, dy, 0.01);
  }
}

// Two dots that are missing tell where the grid is; where a cover leaves room for doubt nothing is told.
TEST(Target, AMarkInAGridTellsItsPlace) {
  const Speckle marked = lattice(-4, 644, {{332, 236}, {284, 284}});
  const Target target = target_of(marked, 1.0);
  int measured = 0;
  for (int k = 0; k < 8; ++k) {
    const Pose moved{.dx = -9.0 + 2.3 * k, .dy = 8.0 - 2.1 * k};
    GrayImage frame = render(marked, moved, {.noise = 1.0, .seed = 40u + static_cast<unsigned>(k)});
    const int hidden = 10 * k;
    if (k % 4 == 1) paint(frame, {0, 0, 240 + hidden, 480}, 90);
    if (k % 4 == 3) paint(frame, {0, 0, 640, 160 + hidden}, 140);
    const Location at = target.locate(frame);
    if (!at.ok) continue;
    ++measured;
    EXPECT_NEAR(at.x_px, moved.dx, 0.05) << k;
    EXPECT_NEAR(at.y_px, moved.dy, 0.05) << k;
  }
  EXPECT_GE(measured, 4);
}

/// With edges as wide as a lens makes them and noise of 1 grey level at most.
GrayImage photographed(const GrayImage& sharp, unsigned random = 1) {
  GrayImage image = sharp;
  for (int y = 1; y < 479; ++y) {
    for (int x = 1; x < 639; ++x) {
      int sum = 0;
      for (int k = -1; k <= 1; ++k) {
        for (int i = -1; i <= 1; ++i) sum += (2 - std::abs(i)) * (2 - std::abs(k)) * sharp.at(x + i, y + k);
      }
      random = 1664525u * random + 1013904223u;
      image.at(x, y) = static_cast<std::uint8_t>(sum / 16 + static_cast<int>(random >> 30) - 1);
    }
  }
  return image;
}

/// A plate with a triangle and a bar, `dx` and `dy` whole pixels from the middle of the target's region.
GrayImage sparse_plate(int dx, int dy) {
  GrayImage sharp{640, 480, std::vector<std::uint8_t>(640 * 480, 110)};
  paint(sharp, {250 + dx, 170 + dy, 140, 140}, 215);
  for (int row = 0; row < 90; ++row) {
    const int half = row / 2;
    paint(sharp, {320 + dx - half, 190 + dy + row, 2 * half, 1}, 20);
  }
  paint(sharp, {260 + dx, 289 + dy, 120, 12}, 20);
  return photographed(sharp);
}

/// Upright bars: but for their ends nothing tells where they are along themselves.
GrayImage bars(int dx, int dy) {
  GrayImage sharp{640, 480, std::vector<std::uint8_t>(640 * 480, 205)};
  for (int bar = 0; bar < 6; ++bar) paint(sharp, {252 + 23 * bar + dx, 175 + dy, 11, 130}, 35);
  return photographed(sharp, static_cast<unsigned>(7 * dx + dy + 100));
}

// Of a target with few edges a cover hides much and shows an edge of its own.
TEST(Target, ACoverOverFewEdgesDoesNotPull) {
  const auto target = Target::create(sparse_plate(0, 0), target_region, {}, "template.png");
  ASSERT_TRUE(target);
  for (const Region cover : {Region{230, 150, 50, 180}, Region{360, 150, 40, 180}, Region{230, 150, 180, 40}}) {
    for (const std::uint8_t level : {std::uint8_t{75}, std::uint8_t{225}}) {
      GrayImage frame = sparse_plate(4, -3);
      paint(frame, cover, level);
      const Location at = target->locate(frame);
      ASSERT_TRUE(at.ok) << at.reason << " under " << cover.x << ' ' << int{level};
      EXPECT_NEAR(at.x_px, 4.0, 0.02) << cover.x << ' ' << int{level};
      EXPECT_NEAR(at.y_px, -3.0, 0.02) << cover.x << ' ' << int{level};
    }
  }
}

// What covers a print of few grey levels is hardly brighter or darker than it: at a glance it passes for part of it.
TEST(Target, AFaintPrintUnderAQuarterOfCoverIsMostlyMeasured) {
  Speckle faint(21);
  for (Speckle::Dot& dot : faint.dots) dot.depth *= 0.5;
  const Target target = target_of(faint, 1.0);
  const Pose moved{.dx = 4.3, .dy = -2.6};
  int measured = 0, tried = 0;
  for (const Region cover :
       {Region{230, 150, 57, 190}, Region{361, 150, 60, 190}, Region{230, 150, 190, 50}, Region{230, 275, 190, 60}}) {
    for (const std::uint8_t level : {std::uint8_t{130}, std::uint8_t{165}, std::uint8_t{200}, std::uint8_t{225}}) {
      GrayImage frame = render(faint, moved, {.noise = 1.0, .seed = 60u + static_cast<unsigned>(tried++)});
      paint(frame, cover, level);
      const Location at = target.locate(frame);
      if (!at.ok) continue;
      ++measured;
      EXPECT_NEAR(at.x_px, moved.dx, 4.0 * at.sigma_x_px) << cover.x << ' ' << int{level};
      EXPECT_NEAR(at.y_px, moved.dy, 4.0 * at.sigma_y_px) << cover.x << ' ' << int{level};
      EXPECT_LT(std::max(at.sigma_x_px, at.sigma_y_px), 0.03);
    }
  }
  EXPECT_GE(measured, 12) << "of " << tried;
}

// More than half hidden, by something with a pattern of its own: measured as well as is said, or not at all.
TEST(Target, UnderALargeCoverNothingWrongIsTold) {
  const auto target = Target::create(sparse_plate(0, 0), target_region, {}, "template.png");
  ASSERT_TRUE(target);
  for (int k = 0; k < 24; ++k) {
    GrayImage frame = sparse_plate(4, -3);
    const int size = 70 + 4 * (k % 6);
    const Region cover = k % 4 == 0   ? Region{230, 150, size, 190}
                         : k % 4 == 1 ? Region{420 - size, 150, size, 190}
                         : k % 4 == 2 ? Region{230, 150, 190, size}
                                      : Region{230, 340 - size, 190, size};
    for (int y = 0; y < cover.height; ++y) {
      const int level = 60 + (y / 9 + k) % 3 * (20 + k);
      paint(frame, {cover.x, cover.y + y, cover.width, 1}, static_cast<std::uint8_t>(level));
    }
    const Location at = target->locate(frame);
    if (!at.ok) continue;
    EXPECT_NEAR(at.x_px, 4.0, std::max(0.02, 4.0 * at.sigma_x_px)) << k;
    EXPECT_NEAR(at.y_px, -3.0, std::max(0.02, 4.0 * at.sigma_y_px)) << k;
  }
}

// With one row of ends hidden the bars' length is all that tells, and a camera may have come closer: the noise between
// the ends must not stand for knowing that it has not.
TEST(Target, NoiseTellsNothingOfAnAxisThatTheTargetHardlyShows) {
  const auto target = Target::create(bars(0, 0), target_region, {}, "template.png");
  ASSERT_TRUE(target);
  const Location whole = target->locate(bars(4, -3));
  ASSERT_TRUE(whole.ok) << whole.reason;
  EXPECT_NEAR(whole.y_px, -3.0, 4.0 * whole.sigma_y_px);
  for (int k = 0; k < 12; ++k) {
    GrayImage frame = bars(4, -3);
    const Region cover = k % 2 == 0 ? Region{230, 150, 180, 30 + 3 * k} : Region{230, 290 - 3 * k, 180, 60 + 3 * k};
    paint(frame, cover, static_cast<std::uint8_t>(40 + 17 * k));
    const Location at = target->locate(frame);
    if (!at.ok) continue;
    EXPECT_NEAR(at.y_px, -3.0, 4.0 * at.sigma_y_px) << k;
  }
}

// Chips within a grid leave both its ends to be seen.
TEST(Target, AGridUnderChipsIsMeasured) {
  const Target target = target_of(grid(), 1.0);
  const Pose moved{.dx = 3.3, .dy = -2.1};
  GrayImage chips = render(grid(), moved, {.noise = 1.0, .seed = 7});
  for (const Region chip : {Region{270, 190, 26, 20}, Region{330, 250, 30, 24}, Region{300, 290, 22, 30}}) {
    paint(chips, chip, 60);
  }
  const Location at = target.locate(chips);
  ASSERT_TRUE(at.ok) << at.reason;
  EXPECT_NEAR(at.x_px, moved.dx, 4.0 * at.sigma_x_px);
  EXPECT_NEAR(at.y_px, moved.dy, 4.0 * at.sigma_y_px);
}

TEST(Target, RefusesWhatIsNotTheTarget) {
  const Target target = target_of(Speckle(4), 1.0);
  EXPECT_FALSE(target.locate(render(Speckle(5), {}, {.noise = 1.0})).ok);
  Speckle nothing(1);
  nothing.dots.clear();
  const Location empty = target.locate(render(nothing, {}, {.noise = 2.0}));
  EXPECT_FALSE(empty.ok);
  EXPECT_EQ(empty.reason, "target missing");
  EXPECT_TRUE(std::isnan(empty.x_px));
  EXPECT_EQ(target.locate(GrayImage{10, 10, std::vector<std::uint8_t>(100)}).refusal, Refusal::other_size);
}

/// Lines on a lattice within a frame, 10 px from one to the next, some of them left out.
GrayImage maze(unsigned lines, int dx, int dy) {
  GrayImage sharp{640, 480, std::vector<std::uint8_t>(640 * 480, 70)};
  std::mt19937 random(lines);
  const int left = 258 + dx, top = 178 + dy;
  for (const int edge : {0, 120}) {
    paint(sharp, {left + edge, top, 5, 125}, 175);
    paint(sharp, {left, top + edge, 125, 5}, 175);
  }
  for (int row = 0; row < 12; ++row) {
    for (int column = 0; column < 12; ++column) {
      const Region along{left + 10 * column, top + 10 * row, 15, 5}, down{left + 10 * column, top + 10 * row, 5, 15};
      paint(sharp, random() % 2 == 0 ? along : down, 175);
    }
  }
  return photographed(sharp, lines + 17u * static_cast<unsigned>(dx + 50));
}

// The frame and the lattice fit, and much of the lines.
TEST(Target, AnotherMazeOfTheSameLatticeIsRefused) {
  const auto target = Target::create(maze(1, 0, 0), target_region, {}, "maze.png");
  ASSERT_TRUE(target);
  GrayImage covered = maze(1, 4, -3);
  paint(covered, {230, 150, 60, 190}, 120);
  for (const GrayImage& frame : {maze(1, 4, -3), covered}) {
    const Location at = target->locate(frame);
    ASSERT_TRUE(at.ok) << at.reason;
    EXPECT_NEAR(at.x_px, 4.0, 0.02);
    EXPECT_NEAR(at.y_px, -3.0, 0.02);
  }
  for (unsigned other = 2; other < 8; ++other) EXPECT_FALSE(target->locate(maze(other, 4, -3)).ok) << other;
}

// A plate in front of a print that stands still, the region around both: of one picture nothing tells which is meant.
TEST(Target, ARegionWhosePartsMoveApartIsRefused) {
  const GrayImage behind = render(Speckle(31, 320.0, 240.0, 460.0));
  const GrayImage plate = render(Speckle(32, 320.0, 240.0, 180.0));
  const auto with_plate_at = [&](int dx, int dy, const GrayImage& shown) {
    GrayImage out = behind;
    for (int y = 170; y < 310; ++y) {
      for (int x = 250; x < 390; ++x) out.at(x + dx, y + dy) = shown.at(x, y);
    }
    return out;
  };
  const auto target = Target::create(with_plate_at(0, 0, plate), {130, 50, 380, 380}, {}, "t.png");
  ASSERT_TRUE(target);
  EXPECT_TRUE(target->locate(with_plate_at(0, 0, plate)).ok);
  for (const int dx : {2, 4, -7, 21}) {
    const Location at = target->locate(with_plate_at(dx, 3, plate));
    EXPECT_FALSE(at.ok) << dx;
    EXPECT_EQ(at.refusal, Refusal::moved_apart) << dx << " " << at.reason;
  }
  // A cover with a print of its own is none of this: what it hides is nowhere else.
  EXPECT_TRUE(target->locate(with_plate_at(4, 3, render(Speckle(33, 320.0, 240.0, 180.0)))).ok);
}

// A few strokes on an even plate, blurred and integrated over each pixel exactly.
GrayImage strokes(double dx, double dy, double depth, double noise, unsigned seed = 1) {
  struct Stroke {
    double left, right, top, bottom;
  };
  constexpr Stroke drawn[] = {{270, 276, 190, 290}, {276, 330, 284, 290}, {300, 370, 200, 205.5},
                              {362, 370, 205, 270}, {310, 316, 225, 262}, {316, 345, 240, 245}};
  constexpr double blur_px = 0.9;
  const auto within = [&](double at, double from, double to) {
    return 0.5 * (std::erf((at - from) / (blur_px * M_SQRT2)) - std::erf((at - to) / (blur_px * M_SQRT2)));
  };
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(0.0, 1.0);
  GrayImage image{640, 480, std::vector<std::uint8_t>(640 * 480)};
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      double level = 150.0 + noise * normal(random);
      for (const Stroke& one : drawn)
        level -= depth * within(x - dx, one.left, one.right) * within(y - dy, one.top, one.bottom);
      image.at(x, y) = static_cast<std::uint8_t>(std::clamp(std::round(level), 0.0, 255.0));
    }
  }
  return image;
}

// Without any noise even places show not even rounding, and beside them every edge looked like an outlier.
TEST(Target, AFrameWithoutNoiseIsNoOccludedOne) {
  const auto target = Target::create(strokes(0.0, 0.0, 95.0, 0.0), target_region, std::nullopt, "template.png");
  ASSERT_TRUE(target);
  for (const auto& [dx, dy] : std::vector<std::pair<double, double>>{{5.92, -3.41}, {1.65, 4.44}, {-7.57, -1.01}}) {
    const Location at = target->locate(strokes(dx, dy, 95.0, 0.0));
    ASSERT_TRUE(at.ok) << at.reason;
    EXPECT_NEAR(at.x_px, dx, 0.01);
    EXPECT_NEAR(at.y_px, dy, 0.01);
    EXPECT_GT(std::min(at.sigma_x_px, at.sigma_y_px), 2e-4);
  }
}

// Noise is not roughness: what it leaves is no sign that a small cover holds the fit elsewhere.
TEST(Target, APrintInNoiseIsMeasuredUnderASmallCover) {
  constexpr double depth = 95.0, noise = 4.0;
  const auto target = Target::create(strokes(0.0, 0.0, depth, noise), target_region, std::nullopt, "template.png");
  ASSERT_TRUE(target);
  for (unsigned k = 0; k < 8; ++k) {
    const double dx = 2.3 - 1.7 * k, dy = -1.1 + 0.9 * k;
    GrayImage frame = strokes(dx, dy, depth, noise, 40 + k);
    for (int y = 150; y < 330; ++y) {
      for (int x = 230; x < 252; ++x) frame.at(x, y) = static_cast<std::uint8_t>(90 + (7 * x + 3 * y) % 9);
    }
    const Location at = target->locate(frame);
    ASSERT_TRUE(at.ok) << at.reason;
    EXPECT_GT(std::max(at.sigma_x_px, at.sigma_y_px), 0.01);
    EXPECT_NEAR(at.x_px, dx, 4.0 * at.sigma_x_px);
    EXPECT_NEAR(at.y_px, dy, 4.0 * at.sigma_y_px);
  }
}

TEST(Target, RefusesRegionsThatCannotWork) {
  const GrayImage image = render(Speckle(1));
  EXPECT_EQ(Target::create(image, {600, 0, 100, 100}, {}, "t.png").error().code, ErrorCode::region_outside_image);
  EXPECT_EQ(Target::create(image, {10, 10, 100, 100}, {}, "t.png").error().code, ErrorCode::template_without_texture);
  EXPECT_EQ(Target::create(image, {10, 10, 5, 5}, {}, "t.png").error().code, ErrorCode::bad_argument);
}

TEST(Target, ErrorsAgreeWithTheStatedUncertainty) {
  const Speckle speckle(7);
  double sum = 0.0;
  const int count = 40;
  for (unsigned k = 0; k < count; ++k) {
    const auto target =
        Target::create(render(speckle, {}, {.noise = 2.0, .seed = 1000 + k}), target_region, {}, "t.png");
    ASSERT_TRUE(target);
    const double dx = 0.13 * k - 2.0;
    const Location at = target->locate(render(speckle, {.dx = dx, .dy = 0.4}, {.noise = 2.0, .seed = 5000 + k}));
    ASSERT_TRUE(at.ok);
    sum += std::pow((at.x_px - dx) / at.sigma_x_px, 2) + std::pow((at.y_px - 0.4) / at.sigma_y_px, 2);
  }
  const double ratio = std::sqrt(sum / (2 * count));
  EXPECT_GT(ratio, 0.7);
  EXPECT_LT(ratio, 1.4);
}

}  // namespace
}  // namespace zerodrift::vision
