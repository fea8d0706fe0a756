#include "core/vision/picture_sketch.h"

#include <gtest/gtest.h>

#include "tests/vision/speckle.h"

namespace zerodrift::vision {
namespace {

const Region target_box{240, 160, 160, 160};

std::shared_ptr<const PictureSketch> sketch(double shift_px, double stamp_s, unsigned seed, double gain = 1.0) {
  GrayImage image = testing::render(testing::Speckle(1), {.dx = shift_px}, {.noise = 1.5, .seed = seed});
  for (auto& pixel : image.pixels) pixel = static_cast<std::uint8_t>(std::min(255.0, gain * pixel));
  return std::make_shared<const PictureSketch>(sketch_of(image, Seconds(stamp_s)));
}

Region cells() {
  return sketch_region(target_box, testing::render(testing::Speckle(1)));
}

TEST(PictureSketch, NoiseAndLightAreNoChange) {
  const Sketches sketches{sketch(0, 1.0, 1), sketch(0, 2.0, 2), sketch(0, 3.0, 3, 0.9)};
  EXPECT_LT(noise_of(sketches, 3, cells()), 4.0);
  EXPECT_FALSE(last_change(sketches, cells(), 1.0));
}

TEST(PictureSketch, AMoveShowsBetweenTheLastPictureBeforeAndTheFirstAfter) {
  const Sketches sketches{sketch(0, 1.0, 1), sketch(0, 2.0, 2), sketch(8, 3.0, 3), sketch(8, 4.0, 4)};
  const auto change = last_change(sketches, cells(), noise_of(sketches, 2, cells()));
  ASSERT_TRUE(change);
  EXPECT_EQ(change->last_other.count(), 2.0);
  EXPECT_EQ(change->first_same.count(), 3.0);
}

TEST(PictureSketch, ATargetThatLeavesTheRegionIsAChange) {
  const Sketches sketches{sketch(0, 1.0, 1), sketch(200, 2.0, 2)};
  EXPECT_TRUE(last_change(sketches, cells(), 1.0));
}

}  // namespace
}  // namespace zerodrift::vision
