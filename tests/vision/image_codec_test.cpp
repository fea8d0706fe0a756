#include "core/vision/image_codec.h"

#include <gtest/gtest.h>

namespace zerodrift::vision {
namespace {

GrayImage ramp(int width, int height) {
  GrayImage image{width, height, std::vector<std::uint8_t>(static_cast<std::size_t>(width) * height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) image.at(x, y) = static_cast<std::uint8_t>((3 * x + 5 * y) % 256);
  }
  return image;
}

TEST(ImageCodec, PngReadsBackTheSame) {
  const GrayImage image = ramp(37, 23);
  const auto bytes = encode_png(image);
  ASSERT_TRUE(bytes);
  const auto back = decode(*bytes, "a.png");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->image.width, 37);
  EXPECT_EQ(back->image.height, 23);
  EXPECT_EQ(back->image.pixels, image.pixels);
  EXPECT_EQ(back->note, "");
}

TEST(ImageCodec, JpegKeepsSizeAndNearlyTheValues) {
  GrayImage image{64, 48, std::vector<std::uint8_t>(64 * 48, 100)};
  const auto bytes = encode_jpeg(image, 90);
  ASSERT_TRUE(bytes);
  const auto back = decode(*bytes, "a.jpg");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->image.width, 64);
  EXPECT_NEAR(back->image.at(30, 20), 100, 2);
}

TEST(ImageCodec, EveryTruncationIsAnError) {
  for (const bool png : {true, false}) {
    const auto bytes = png ? encode_png(ramp(64, 64)) : encode_jpeg(ramp(64, 64), 80);
    ASSERT_TRUE(bytes);
    for (std::size_t size = 0; size + 1 < bytes->size(); size += 7) {
      const auto part = decode(std::span(bytes->data(), size), "cut");
      ASSERT_FALSE(part) << size;
      EXPECT_EQ(part.error().code, ErrorCode::image_unreadable);
      EXPECT_EQ(part.error().context.at("file"), "cut");
    }
  }
}

TEST(ImageCodec, AHugeSizeInTheHeaderIsRefused) {
  auto bytes = encode_png(ramp(64, 64));
  ASSERT_TRUE(bytes);
  std::fill(bytes->begin() + 16, bytes->begin() + 24, std::uint8_t{0xff});  // 4294967295 x 4294967295
  const auto picture = decode(*bytes, "a.png");
  ASSERT_FALSE(picture);
  EXPECT_NE(picture.error().context.at("detail").find("100 megapixels"), std::string::npos);
}

TEST(ImageCodec, OtherFilesAreNamed) {
  const std::vector<std::uint8_t> text{'h', 'e', 'l', 'l', 'o'};
  const auto result = decode(text, "notes.txt");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().context.at("detail").find("not a PNG"), std::string::npos);
}

}  // namespace
}  // namespace zerodrift::vision
