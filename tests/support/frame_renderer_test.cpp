#include "tests/support/frame_renderer.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <cmath>

#include "tests/support/frame_set.h"
#include "tests/support/png_writer.h"

namespace zerodrift::test_support {
namespace {

/// No lens, no vignetting, square axes: a shift by whole pixels must then give the same grey levels again.
Camera plain_camera() {
  Camera camera;
  camera.distortion_per_px2 = 0.0;
  camera.vignetting_per_px2 = 0.0;
  camera.rotation_rad = 0.0;
  return camera;
}

Vector2 um_of_px(const Camera& camera, double x_px, double y_px) {
  return {x_px * camera.um_per_px, -y_px * camera.um_per_px};
}

class EveryTarget : public testing::TestWithParam<PatternKind> {};

TEST_P(EveryTarget, ShiftByWholePixelsRepeatsTheLevels) {
  const Camera camera = plain_camera();
  const FrameRenderer renderer(camera, {Pattern(GetParam(), 90.0 * camera.um_per_px, 3), {}, {}});
  FrameSpec here;
  FrameSpec there;
  here.target.shift_um = um_of_px(camera, 0.37, -0.81);
  there.target.shift_um = um_of_px(camera, 5.37, -4.81);
  const auto a = renderer.levels(here);
  const auto b = renderer.levels(there);
  for (int y = 170; y < 310; ++y) {
    for (int x = 250; x < 390; ++x) {
      if (GetParam() == PatternKind::ball && std::hypot(x - 319.5, y - 239.5) > 78.0)
        continue;  // ground shows beside it
      ASSERT_NEAR(a[static_cast<std::size_t>(y) * 640 + x], b[static_cast<std::size_t>(y - 4) * 640 + x + 5], 1e-9)
          << x << " " << y;
    }
  }
}

/// One Gauss-Newton step with exact derivatives, linear in the small shift: what is left is second order.
TEST_P(EveryTarget, SmallShiftIsFoundByItsOwnDerivative) {
  const Camera camera = plain_camera();
  const FrameRenderer renderer(camera, {Pattern(GetParam(), 90.0 * camera.um_per_px, 3), {}, {}});
  const auto at = [&](double x_px, double y_px) {
    FrameSpec spec;
    spec.target.shift_um = um_of_px(camera, x_px, y_px);
    return renderer.levels(spec);
  };
  const auto still = at(0.0, 0.0);
  const auto right = at(1e-3, 0.0);
  const auto left = at(-1e-3, 0.0);
  const auto moved = at(0.01, 0.02);
  const auto down = at(0.0, 1e-3);
  const auto up = at(0.0, -1e-3);
  Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
  Eigen::Vector2d side = Eigen::Vector2d::Zero();
  for (std::size_t i = 0; i < still.size(); ++i) {
    const Eigen::Vector2d row((right[i] - left[i]) / 2e-3, (down[i] - up[i]) / 2e-3);
    normal += row * row.transpose();
    side += row * (moved[i] - still[i]);
  }
  const Eigen::Vector2d found = normal.ldlt().solve(side);
  EXPECT_NEAR(found.x(), 0.01, 2e-5);
  EXPECT_NEAR(found.y(), 0.02, 2e-5);
}

INSTANTIATE_TEST_SUITE_P(Targets, EveryTarget, testing::ValuesIn(target_kinds),
                         [](const auto& kind) { return name_of(kind.param); });

TEST(FrameRenderer, PixelAndObjectAreInverse) {
  const Session session = make_session(PatternKind::rings, Disturbance::camera_drift, 4, 4);
  for (const FrameSpec& spec : session.frames) {
    for (const Vector2 pixel : {Vector2{0, 0}, Vector2{639, 0}, Vector2{123.4, 456.7}}) {
      const Vector2 back =
          session.renderer.pixel_from_object(session.renderer.object_from_pixel(pixel, spec.camera), spec.camera);
      EXPECT_NEAR(back.x, pixel.x, 1e-9);
      EXPECT_NEAR(back.y, pixel.y, 1e-9);
    }
  }
}

TEST(FrameRenderer, MachineRightAndUpAreRightAndUpInThePicture) {
  const FrameRenderer renderer(plain_camera(), {Pattern(PatternKind::rings, 1000.0, 1), {}, {}});
  const Vector2 origin = renderer.pixel_from_object({0.0, 0.0});
  EXPECT_GT(renderer.pixel_from_object({100.0, 0.0}).x, origin.x);
  EXPECT_LT(renderer.pixel_from_object({0.0, 100.0}).y, origin.y);
}

TEST(FrameSet, TruthOfRotationIsThatOfThePoint) {
  Session session = make_session(PatternKind::checkerboard, Disturbance::rotation, 2, 1);
  FrameSpec spec;
  spec.target.rotation_rad = 0.0174533;
  session.point_px = {session.point_px.x + 100.0, session.point_px.y};
  const Vector2 shift = truth_of(session, spec).shift_px;
  EXPECT_NEAR(std::hypot(shift.x, shift.y), 1.745, 0.03);  // 1 degree at 100 px, and the target's off-centre home
}

TEST(FrameSet, CameraDriftIsSeenByTargetAndMarks) {
  const Session session = make_session(PatternKind::rings, Disturbance::camera_drift, 2, 6);
  const FrameTruth truth = truth_of(session, session.frames[0]);
  ASSERT_EQ(truth.marks_px.size(), 2U);
  FrameSpec without = session.frames[0];
  without.camera = {};
  const FrameTruth still = truth_of(session, without);
  EXPECT_EQ(still.marks_px[0].x, 0.0);
  EXPECT_EQ(still.shift_um.x, truth.shift_um.x);
  EXPECT_NEAR(truth.shift_px.x - still.shift_px.x, truth.marks_px[0].x, 0.02);
  EXPECT_GT(std::abs(truth.marks_px[0].x), 0.1);
}

TEST(FrameSet, SameSeedSameBytes) {
  const Session a = make_session(PatternKind::speckle, Disturbance::occluded, 5, 2);
  const Session b = make_session(PatternKind::speckle, Disturbance::occluded, 5, 2);
  EXPECT_EQ(a.renderer.render(a.frames[1]).pixels, b.renderer.render(b.frames[1]).pixels);
  EXPECT_NE(a.renderer.render(a.frames[0]).pixels, a.renderer.render(a.frames[1]).pixels);
}

TEST(FrameSet, BoundIsOfTheSizeTheNoiseGives) {
  for (const PatternKind kind : target_kinds) {
    const Session clean = make_session(kind, Disturbance::clean, 1, 1);
    const Session noisy = make_session(kind, Disturbance::noise, 1, 1);
    const Vector2 low = cramer_rao_px(clean, clean.frames[0]);
    const Vector2 high = cramer_rao_px(noisy, noisy.frames[0]);
    const double least = kind == PatternKind::ball ? 3e-4 : 3e-5;
    EXPECT_GT(low.x, least) << name_of(kind);
    EXPECT_LT(low.x, 2e-3) << name_of(kind);
    EXPECT_GT(high.x, 3.0 * low.x) << name_of(kind);
    EXPECT_LT(high.x, 1e-2) << name_of(kind);
  }
}

TEST(PngWriter, RowsComeBackThroughZlib) {
  const Frame frame{3, 2, {1, 2, 3, 250, 251, 252}};
  const auto bytes = png_bytes(frame);
  ASSERT_EQ(bytes[1], 'P');
  // Signature 8, header chunk 25, then the length and type of the data chunk.
  const std::size_t size = (static_cast<std::size_t>(bytes[35]) << 8) + bytes[36];
  std::vector<std::uint8_t> rows(64);
  uLongf length = rows.size();
  ASSERT_EQ(uncompress(rows.data(), &length, bytes.data() + 41, static_cast<uLong>(size)), Z_OK);
  rows.resize(length);
  EXPECT_EQ(rows, (std::vector<std::uint8_t>{0, 1, 2, 3, 0, 250, 251, 252}));
}

}  // namespace
}  // namespace zerodrift::test_support
