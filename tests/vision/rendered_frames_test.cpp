// The image measurement on rendered frames whose displacement is exact, one small session for each thing that has to
// hold; the figures of all sets are in docs/explanation/measuring-accuracy.md.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/base/noise.h"
#include "core/vision/image_quality.h"
#include "core/vision/lens_term.h"
#include "core/vision/target.h"
#include "tests/support/amount.h"
#include "tests/support/frame_set.h"

namespace zerodrift::vision {
namespace {

using test_support::Disturbance;
using test_support::PatternKind;

GrayImage image_of(const test_support::Frame& frame) {
  return {frame.width_px, frame.height_px, frame.pixels};
}

Region region_of(const test_support::PixelRegion& at) {
  return {at.x, at.y, at.width, at.height};
}

Result<Target> target_of(const test_support::Session& session) {
  return Target::create(image_of(session.renderer.render(session.template_spec)), region_of(session.roi), std::nullopt,
                        "template");
}

std::vector<GrayImage> views_of(const test_support::Session& session) {
  std::vector<GrayImage> views;
  for (const auto& view : session.grid_views) views.push_back(image_of(session.renderer.render(view.spec)));
  return views;
}

// Largest error in px over the frames, all of which must be measured.
double largest_error_px(PatternKind kind, Disturbance disturbance, std::uint64_t seed, int frames = 4) {
  const test_support::Session session = test_support::make_session(kind, disturbance, seed, frames);
  const auto target = target_of(session);
  if (!target) return std::nan("");
  const Target learned = target->learned_from(views_of(session));
  double worst = 0.0;
  for (const auto& spec : session.frames) {
    const Location at = learned.locate(image_of(session.renderer.render(spec)));
    EXPECT_TRUE(at.ok) << at.reason;
    const auto truth = test_support::truth_of(session, spec).shift_px;
    worst = std::max({worst, std::abs(at.x_px - truth.x), std::abs(at.y_px - truth.y)});
  }
  return worst;
}

}  // namespace

// From moves that show it the lens is found; what small ones say counts where it is right or not at all.
TEST(RenderedFrames, ALensIsFoundFromMovesThatShowIt) {
  for (const PatternKind kind : {PatternKind::speckle, PatternKind::code, PatternKind::ball}) {
    for (const double half_span_px : {0.0, 10.0}) {
      const test_support::Session session = test_support::make_session(kind, Disturbance::clean, 21, 1, half_span_px);
      const auto target = target_of(session);
      ASSERT_TRUE(target);
      const LensTerm lens = target->learned_from(views_of(session)).lens();
      const double truth = -session.renderer.camera().distortion_per_px2;  // that is from distorted to true radius
      ASSERT_GT(std::abs(truth), 4e-9);
      // The term is about the named point, the lens about the middle of the picture.
      const double wide_error = 0.35 * std::abs(truth);
      const bool wide = half_span_px == 0.0;
      EXPECT_NEAR(lens.per_px2, truth, wide_error + (wide ? 0.0 : 4.0 * lens.sigma_per_px2));
      EXPECT_TRUE(!wide || std::abs(lens.per_px2) > 3.0 * lens.sigma_per_px2);
    }
  }
}

// Its rim was once found 1.3 px too small before what had been learned of the backdrop, and followed in no frame.
TEST(RenderedFrames, ADarkBallBeforeALearnedBackdropIsMeasuredInChangedLight) {
  EXPECT_LT(largest_error_px(PatternKind::ball, Disturbance::light, 690089999, 6), 0.03);
}

TEST(LensTerm, CountsWhenItStandsOutOrIsKnownFarBetterThanBefore) {
  const LensTerm prior;
  const auto of_views = [&](double per_px2, double own_sigma) {
    const double own = 1.0 / (own_sigma * own_sigma), before = 1.0 / (prior.sigma_per_px2 * prior.sigma_per_px2);
    return combined(prior, std::vector<LensTerm>(9, {own * per_px2 / (own + before), 1.0 / std::sqrt(own + before)}));
  };
  // Nine views know it 2.1 times better than one: their noise is in part the template's.
  const LensTerm two_sigma = of_views(1e-8, 1.06e-8);
  // Trusted to three times that, it is known as well as before: half of it is believed.
  EXPECT_NEAR(two_sigma.per_px2, 5e-9, 2e-10);
  EXPECT_NEAR(two_sigma.sigma_per_px2, prior.sigma_per_px2 / std::sqrt(2.0), 3e-10);
  EXPECT_NEAR(of_views(2e-8, 1.06e-8).per_px2, 1.8e-8, 1e-9);
  const LensTerm straight = of_views(1e-10, 1e-9);
  EXPECT_NEAR(straight.per_px2, 1e-10, 1e-12);
  EXPECT_LT(straight.sigma_per_px2, 1e-9);
  EXPECT_EQ(combined(prior, {}).sigma_per_px2, prior.sigma_per_px2);
}

// A plate is measured to some thousandths of a pixel whatever is printed on it; five sigma of the worst set.
TEST(RenderedFrames, APlateOfAnyDesignIsMeasuredUnderAHalo) {
  EXPECT_LT(largest_error_px(PatternKind::code, Disturbance::glare, 77), 0.012);
  EXPECT_LT(largest_error_px(PatternKind::rings, Disturbance::glare, 77), 0.012);
}

// Rings tell nothing of a turn; in the first of these frames rounding makes it less than nothing.
TEST(RenderedFrames, RingsAreMeasuredWhereNothingIsKnownOfTheirTurn) {
  EXPECT_LT(largest_error_px(PatternKind::rings, Disturbance::clean, 707145107, 3), 0.001);
}

TEST(RenderedFrames, ChipsOnTheTargetPullNothing) {
  EXPECT_LT(largest_error_px(PatternKind::checkerboard, Disturbance::occluded, 77), 0.008);
}

TEST(RenderedFrames, AGlaringSpotDoesNotHideTheBall) {
  EXPECT_LT(largest_error_px(PatternKind::ball, Disturbance::glare, 77), 0.1);
}

// A polished ball shows little but its outline, through which what stands behind it draws the result.
TEST(RenderedFrames, WhatStandsBehindABallDoesNotDrawIt) {
  EXPECT_LT(largest_error_px(PatternKind::ball, Disturbance::large_motion, 77), 0.03);
  const test_support::Session session = test_support::make_session(PatternKind::ball, Disturbance::clean, 77, 1);
  const auto target = target_of(session);
  ASSERT_TRUE(target);
  std::vector<GrayImage> views = views_of(session);
  const auto backdrop = target->learned_from(views).backdrop();
  ASSERT_TRUE(backdrop);
  const FloatImage& clear = backdrop->clear;
  EXPECT_GT(clear.row(2)[2], 0.9f);
  EXPECT_LT(clear.row(clear.height / 2)[clear.width / 2], 0.1f);
  // Where the target now stands, the other frames show what it hides.
  test_support::FrameSpec bare = session.template_spec;
  bare.target_present = false;
  const auto truth = session.renderer.levels(bare);
  const int x = session.roi.x + 20;
  const int y = session.roi.y + session.roi.height / 2;
  const double behind = truth[static_cast<std::size_t>(y) * session.renderer.camera().width_px + x];
  EXPECT_NEAR(backdrop->at(static_cast<float>(x), static_cast<float>(y)), behind, 1.5);
  // Two frames are too few to tell one from the other.
  views.resize(2);
  EXPECT_FALSE(target->learned_from(views).backdrop());
}

// A ball shows so little that the noise of one picture of it is a third of all its gradients. The mean of the views has
// less; displacements stay those since the template's picture.
TEST(RenderedFrames, ABallInNoiseIsLookedForByTheMeanOfItsViews) {
  double squares_alone = 0.0, squares = 0.0;
  const auto seeds = static_cast<std::uint64_t>(amount(2, 6));
  for (std::uint64_t seed = 78; seed < 78 + seeds; ++seed) {
    const test_support::Session session = test_support::make_session(PatternKind::ball, Disturbance::noise, seed, 3);
    const auto target = target_of(session);
    ASSERT_TRUE(target);
    const Target learned = target->learned_from(views_of(session));
    ASSERT_TRUE(learned.gathered() && learned.backdrop());
    const Target alone = target->with_backdrop(learned.backdrop()).with_mask(learned.mask()).with_lens(learned.lens());
    EXPECT_EQ(alone.gathered(), nullptr);
    const Location zero = learned.locate(learned.image());
    ASSERT_TRUE(zero.ok);
    EXPECT_NEAR(std::hypot(zero.x_px, zero.y_px), 0.0, 1e-6);
    for (const auto& spec : session.frames) {
      const GrayImage frame = image_of(session.renderer.render(spec));
      const auto truth = test_support::truth_of(session, spec).shift_px;
      const auto square = [&](const Location& at) {
        EXPECT_TRUE(at.ok) << at.reason;
        return std::pow(at.x_px - truth.x, 2) + std::pow(at.y_px - truth.y, 2);
      };
      squares_alone += square(alone.locate(frame));
      squares += square(learned.locate(frame));
    }
  }
  EXPECT_LT(std::sqrt(squares / (6.0 * static_cast<double>(seeds))), 0.010);
  EXPECT_LT(squares, squares_alone);
  // A print says so much that its noise does no harm.
  const test_support::Session print = test_support::make_session(PatternKind::speckle, Disturbance::clean, 78, 1);
  const auto target = target_of(print);
  ASSERT_TRUE(target);
  const Target learned = target->learned_from(views_of(print));
  EXPECT_EQ(learned.gathered(), nullptr);
  const Region& at = learned.region();
  EXPECT_EQ(learned.with_gathered(FloatImage(at.width, at.height)).gathered(), nullptr);  // of another size
  // And what does not show the target at all is no mean of it.
  const FloatImage even(at.width + 2 * template_margin_px, at.height + 2 * template_margin_px);
  EXPECT_EQ(learned.with_gathered(even).gathered(), nullptr);
}

// A dark ball of little contrast in a noise of 1.5 grey levels; its highlight beside where it was by `turned_px`.
GrayImage faint_ball(double x_px, double y_px, double turned_px, unsigned seed) {
  Noise noise(seed);
  GrayImage out{640, 480, std::vector<std::uint8_t>(640 * 480)};
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const double behind = 90.0 + 6.0 * std::sin(x / 23.0) * std::cos(y / 31.0);
      const double dx = x - 320.0 - x_px;
      const double dy = y - 240.0 - y_px;
      const double inside = 0.5 * std::erfc((std::hypot(dx, dy) - 80.0) / (std::sqrt(2.0) * 0.9));
      const double lamp = std::hypot(dx + 25.0 - turned_px, dy + 30.0 - turned_px);
      const double ball = 60.0 - 0.1 * dy + 130.0 * std::exp(-0.5 * lamp * lamp / 60.0);
      const double level = (1.0 - inside) * behind + inside * ball + 1.5 * noise.normal();
      out.pixels[static_cast<std::size_t>(y) * out.width + x] =
          static_cast<std::uint8_t>(std::lround(std::clamp(level, 0.0, 255.0)));
    }
  }
  return out;
}

// What a ball shows within its outline is the lamp: turned, it must not carry the ball along, and noise must not hide
// where the outline ends.
TEST(RenderedFrames, ALampThatIsTurnedDoesNotMoveABallOfLittleContrast) {
  const auto target = Target::create(faint_ball(0, 0, 0, 1), {230, 150, 180, 180}, std::nullopt, "template");
  ASSERT_TRUE(target);
  std::vector<GrayImage> views;
  for (int k = 0; k < 9; ++k) views.push_back(faint_ball(22.3 * (k % 3 - 1), 21.7 * (k / 3 - 1), 0, 10 + k));
  const Target learned = target->learned_from(views);
  ASSERT_TRUE(learned.backdrop());
  for (unsigned k = 0; k < 4; ++k) {
    const Location at = learned.locate(faint_ball(3.4, -2.7, 0.15 + 0.15 * k, 30 + k));
    if (!at.ok) continue;
    EXPECT_NEAR(at.x_px, 3.4, 0.1);
    EXPECT_NEAR(at.y_px, -2.7, 0.1);
  }
}

// A region drawn too wide over rough metal: what stands still in it has more contrast than the print, so that every
// picture of the calibration looks hidden in part until that has been learned.
TEST(RenderedFrames, ARegionTooWideOverRoughMetalIsLearnedFromTheMoves) {
  const test_support::Session session = test_support::make_session(PatternKind::speckle, Disturbance::clean, 77, 3);
  const auto picture = [&](const test_support::FrameSpec& spec) {
    GrayImage image = image_of(session.renderer.render(spec));
    const auto shift = test_support::truth_of(session, spec).shift_px;
    const Region roi = region_of(session.roi);
    Noise grinding(5);
    for (int y = 0; y < image.height; ++y) {
      const double groove = 90.0 + 50.0 * grinding.normal();
      for (int x = 0; x < image.width; ++x) {
        const double beside = std::max(std::abs(x - shift.x - roi.x - 0.5 * roi.width) - 0.5 * roi.width,
                                       std::abs(y - shift.y - roi.y - 0.5 * roi.height) - 0.5 * roi.height);
        auto& level = image.pixels[static_cast<std::size_t>(y) * image.width + x];
        const double share = std::clamp(beside, 0.0, 1.0);
        level = static_cast<std::uint8_t>(std::clamp((1.0 - share) * level + share * groove, 0.0, 250.0));
      }
    }
    return image;
  };
  Region wide = region_of(session.roi);
  wide = {wide.x - 16, wide.y - 16, wide.width + 32, wide.height + 32};
  const auto target = Target::create(picture(session.template_spec), wide, std::nullopt, "template");
  ASSERT_TRUE(target);
  std::vector<GrayImage> views;
  int refused = 0;
  for (const auto& view : session.grid_views) {
    views.push_back(picture(view.spec));
    refused += !target->locate(views.back()).ok;
  }
  EXPECT_GE(refused, 6);
  const Target learned = target->learned_from(views);
  for (const auto& spec : session.frames) {
    const Location at = learned.locate(picture(spec));
    EXPECT_TRUE(at.ok) << at.reason;
    const auto truth = test_support::truth_of(session, spec).shift_px;
    EXPECT_NEAR(at.x_px, truth.x, 0.05);
    EXPECT_NEAR(at.y_px, truth.y, 0.05);
  }
}

TEST(RenderedFrames, BlurIsToldWhateverThePattern) {
  for (const PatternKind kind : {PatternKind::checkerboard, PatternKind::rings, PatternKind::code}) {
    const test_support::Session session = test_support::make_session(kind, Disturbance::clean, 5, 1);
    for (const double blur_px : {1.0, 1.8}) {
      test_support::FrameSpec spec = session.template_spec;
      spec.blur_px = blur_px;
      const ImageQuality found = quality_of(image_of(session.renderer.render(spec)), region_of(session.roi));
      EXPECT_NEAR(found.blur_px, blur_px, 0.25 * blur_px) << test_support::name_of(kind);
    }
  }
}

// Spokes look the same at any size: within the smaller of two stars everything fits, and only its rim tells. The seeds
// draw 14 to 21 spokes, so some of these stars have as many as the template's.
TEST(RenderedFrames, AStarOfAnotherSizeIsNotTheTarget) {
  const test_support::Session session = test_support::make_session(PatternKind::siemens_star, Disturbance::clean, 5, 1);
  const auto target = target_of(session);
  ASSERT_TRUE(target);
  const double half_um = session.renderer.stage().target.half_um();
  for (const double size : {0.84, 1.19}) {
    for (std::uint64_t seed = 1; seed <= 24; ++seed) {
      test_support::FrameSpec spec = session.frames.front();
      spec.other_target = std::make_shared<test_support::Pattern>(PatternKind::siemens_star, size * half_um, seed);
      const Location at = target->locate(image_of(session.renderer.render(spec)));
      EXPECT_FALSE(at.ok) << "size " << size << ", seed " << seed;
    }
  }
  EXPECT_TRUE(target->locate(image_of(session.renderer.render(session.frames.front()))).ok);
}

// Another code of the same make fits with its frame and with half of its cells.
TEST(RenderedFrames, AnotherCodeIsNotTheTarget) {
  const test_support::Session session = test_support::make_session(PatternKind::code, Disturbance::clean, 5, 1);
  const auto target = target_of(session);
  ASSERT_TRUE(target);
  const double half_um = session.renderer.stage().target.half_um();
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    test_support::FrameSpec spec = session.frames.front();
    spec.other_target = std::make_shared<test_support::Pattern>(PatternKind::code, half_um, seed);
    const Location at = target->locate(image_of(session.renderer.render(spec)));
    EXPECT_FALSE(at.ok) << "seed " << seed << " " << at.correlation << " " << at.inlier_share;
  }
  // The same cells under chips are the same target.
  EXPECT_LT(largest_error_px(PatternKind::code, Disturbance::occluded, 5), 0.012);
}

}  // namespace zerodrift::vision
