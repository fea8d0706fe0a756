#include "core/vision/target.h"

#include <gtest/gtest.h>

#include <chrono>

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
    EXPECT_LT(at.sigma_x_px, 0.001);
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
