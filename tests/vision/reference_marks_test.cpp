// Fixed marks beside the target while the camera itself shifts, turns and changes its scale.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "core/vision/camera_error_source.h"
#include "core/vision/error_view.h"
#include "core/vision/image_codec.h"
#include "core/vision/measure_files.h"
#include "tests/support/own_folder.h"
#include "tests/vision/speckle.h"

namespace zerodrift::vision {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::render;
using testing::Speckle;

struct CameraDrift {
  double dx_px = 0.0, dy_px = 0.0;
  double roll_rad = 0.0, scale = 0.0;  // about the middle of the picture
};

constexpr Region plate_region{260, 180, 120, 120};
constexpr Region left_region{52, 302, 96, 96};
constexpr Region right_region{492, 302, 96, 96};

/// The target in the middle, a mark at the left and one at the right below it; `hidden` leaves one of them out.
GrayImage marked_scene(double target_dx, const CameraDrift& camera, unsigned seed, int hidden = -1) {
  Speckle all(1, 320.0 + target_dx, 240.0, 110.0);
  const std::vector<Speckle> marks{Speckle(8, 100.0, 350.0, 90.0), Speckle(9, 540.0, 350.0, 90.0)};
  for (int k = 0; k < 2; ++k) {
    const auto& dots = marks[static_cast<std::size_t>(k)].dots;
    if (k != hidden) all.dots.insert(all.dots.end(), dots.begin(), dots.end());
  }
  const double grown = 1.0 + camera.scale;
  const double c = grown * std::cos(camera.roll_rad), s = grown * std::sin(camera.roll_rad);
  for (Speckle::Dot& dot : all.dots) {
    const double x = dot.x - 320.0, y = dot.y - 240.0;
    dot.x = 320.0 + camera.dx_px + c * x - s * y;
    dot.y = 240.0 + camera.dy_px + s * x + c * y;
    dot.sigma *= grown;
  }
  return render(all, {}, {.noise = 0.5, .seed = seed});
}

Target made(const Region& at) {
  return *Target::create(marked_scene(0.0, {}, 1), at, std::nullopt, "t");
}

// 0.3 mrad and 2 in 10 000: a holder that warms up by some K.
constexpr CameraDrift turned{0.8, -0.6, 3e-4, -2e-4};

TEST(ReferenceMarks, WhatTheyTakeOff) {
  EXPECT_EQ(taken_off_by(std::vector<Region>{}), TakenOff::nothing);
  EXPECT_EQ(taken_off_by({left_region}), TakenOff::shift);
  EXPECT_EQ(taken_off_by({left_region, right_region}), TakenOff::shift_turn_scale);
  EXPECT_EQ(taken_off_by({left_region, {left_region.x + 100, left_region.y, 96, 96}}), TakenOff::shift);
}

TEST(ReferenceMarks, ASecondOneTakesTurnAndScaleOff) {
  const Target target = made(plate_region);
  const Target left = made(left_region), right = made(right_region);
  double one_px = 0.0, two_px = 0.0, two_sigmas = 0.0;
  const int frames = 6;
  for (int k = 0; k < frames; ++k) {
    const double moved = 0.4 * k;
    const GrayImage frame = marked_scene(moved, turned, 10 + static_cast<unsigned>(k));
    const Location one = locate_against(target, {left}, frame);
    const Location two = locate_against(target, {left, right}, frame);
    ASSERT_TRUE(one.ok && two.ok) << one.reason << two.reason;
    one_px += (std::pow(one.x_px - moved, 2) + std::pow(one.y_px, 2)) / frames;
    two_px += (std::pow(two.x_px - moved, 2) + std::pow(two.y_px, 2)) / frames;
    two_sigmas += (std::pow((two.x_px - moved) / two.sigma_x_px, 2) + std::pow(two.y_px / two.sigma_y_px, 2)) / frames;
  }
  std::printf("turn 0.3 mrad and scale 2 in 10 000: rms %.4f px with one mark, %.4f px with two (%.2f stated)\n",
              std::sqrt(one_px), std::sqrt(two_px), std::sqrt(two_sigmas / 2.0));
  // Left to the one mark: 3.6 in 10 000 of the 246 px to the target.
  EXPECT_NEAR(std::sqrt(one_px), 0.0887, 0.01);
  EXPECT_LT(std::sqrt(two_px), 0.01);
  EXPECT_LT(std::sqrt(two_sigmas / 2.0), 2.5);
}

TEST(ReferenceMarks, WithoutOneOfTwoTheOtherServesAndTheUncertaintySaysSo) {
  const Target target = made(plate_region);
  const std::vector<Target> marks{made(left_region), made(right_region)};
  const GrayImage whole = marked_scene(1.5, turned, 20);
  const GrayImage covered = marked_scene(1.5, turned, 21, 1);
  const Location both = locate_against(target, marks, whole);
  std::vector<Location> seen;
  const Location alone = locate_against(target, marks, covered, &seen);
  ASSERT_TRUE(alone.ok) << alone.reason;
  EXPECT_EQ(marks_not_seen(seen).rfind("reference 2: ", 0), 0u) << marks_not_seen(seen);
  // What roll and scale may be is not known: 1 in 10 000 of the way from the mark.
  EXPECT_GT(alone.sigma_x_px, 0.02);
  EXPECT_GT(alone.sigma_x_px, 4.0 * both.sigma_x_px);
  EXPECT_LT(std::hypot(alone.x_px - 1.5, alone.y_px), 4.0 * alone.sigma_x_px);
  // Further frames do not average that away.
  EXPECT_NEAR(mean_of({alone, alone, alone, alone}).location.sigma_x_px, alone.shared_sigma_px, 0.005);
  // Where they were seen a moment ago, they count as last seen.
  CameraTurn turn;
  ASSERT_TRUE(locate_against(target, marks, whole, nullptr, &turn).ok);
  EXPECT_NEAR(turn.roll_rad, turned.roll_rad, 4e-5);
  EXPECT_NEAR(turn.scale, turned.scale, 4e-5);
  const Location kept = locate_against(target, marks, covered, nullptr, &turn);
  ASSERT_TRUE(kept.ok);
  EXPECT_LT(std::hypot(kept.x_px - 1.5, kept.y_px), 0.02);
  EXPECT_GT(kept.sigma_x_px, 0.02);
  EXPECT_NEAR(turn.roll_rad, turned.roll_rad, 4e-5);
}

TEST(ReferenceMarks, WithNoneNothingIsMeasured) {
  const std::vector<Target> marks{made(left_region), made(right_region)};
  const Location at = locate_against(made(plate_region), marks, render(Speckle(1, 320.0, 240.0, 110.0)));
  EXPECT_FALSE(at.ok);
  EXPECT_EQ(at.reason.rfind("reference 1: ", 0), 0u) << at.reason;
  EXPECT_NE(at.reason.find("; reference 2: "), std::string::npos) << at.reason;
}

TEST(ReferenceMarks, AFolderIsMeasuredWithWhatEachFrameShows) {
  const fs::path folder = own_folder("zerodrift_reference_folder_test");
  fs::remove_all(folder);
  fs::create_directories(folder);
  ASSERT_TRUE(write_png(folder / "a.png", marked_scene(1.5, turned, 40)));
  ASSERT_TRUE(write_png(folder / "b.png", marked_scene(1.5, turned, 41, 1)));
  LocateRequest request;
  request.references = {made(left_region), made(right_region)};
  request.learn = false;
  std::vector<std::string> warnings;
  const auto found = locate_in_folder(made(plate_region), request, folder, &warnings, {});
  ASSERT_TRUE(found) << describe(found.error());
  ASSERT_EQ(found->size(), 2u);
  ASSERT_TRUE((*found)[0].location.ok && (*found)[1].location.ok);
  EXPECT_GT((*found)[1].location.sigma_x_px, 4.0 * (*found)[0].location.sigma_x_px);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].rfind("b.png was measured without reference 2: ", 0), 0u) << warnings[0];
  fs::remove_all(folder);
}

TEST(ReferenceMarks, ARunSaysWhichOneIsNotSeen) {
  const fs::path folder = own_folder("zerodrift_reference_marks_test");
  fs::remove_all(folder);
  fs::create_directories(folder / "whole");
  fs::create_directories(folder / "covered");
  ASSERT_TRUE(write_png(folder / "whole" / "img_0000.png", marked_scene(0.0, turned, 30)));
  ASSERT_TRUE(write_png(folder / "covered" / "img_0000.png", marked_scene(1.5, turned, 31, 0)));
  const auto source_of = [&](const char* name) {
    ErrorView view;
    view.id = "front";
    view.camera = std::make_shared<const Camera>((folder / name / "img_%04d.png").string());
    view.target = std::make_shared<const Target>(made(plate_region));
    view.references = {made(left_region), made(right_region)};
    view.calibration.um_from_px << 12.0, 0.0, 0.0, -12.0;
    return CameraErrorSource({view}, {.frames = 3});
  };
  CameraErrorSource whole = source_of("whole");
  ASSERT_TRUE(whole.restore_zero({{0, 0, 0, 0}}));
  const auto plain = whole.measure(acquisition::standing_now(), {});
  ASSERT_TRUE(plain) << describe(plain.error());
  EXPECT_FALSE(plain->remark);
  CameraErrorSource covered = source_of("covered");
  ASSERT_TRUE(covered.restore_zero({{0, 0, 0, 0}}));
  const auto sample = covered.measure(acquisition::standing_now(), {});
  ASSERT_TRUE(sample) << describe(sample.error());
  EXPECT_TRUE(sample->problems.empty());
  ASSERT_TRUE(sample->remark);
  EXPECT_EQ(sample->remark->code, ErrorCode::reference_lost);
  EXPECT_EQ(sample->remark->context.at("reason").rfind("camera front: reference 1: ", 0), 0u);
  EXPECT_NEAR(sample->error_um[0], 18.0, 4.0 * sample->sigma_um[0]);
  EXPECT_GT(sample->sigma_um[0], 4.0 * plain->sigma_um[0]);
  ASSERT_EQ(covered.states()[0].marks.size(), 2u);
  EXPECT_FALSE(covered.states()[0].references[0].ok);
  EXPECT_TRUE(covered.states()[0].references[1].ok);
  fs::remove_all(folder);
}

}  // namespace
}  // namespace zerodrift::vision
