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

// Of 24 bits, as cameras write it.
std::vector<std::uint8_t> bmp_of(const GrayImage& image) {
  std::vector<std::uint8_t> bytes = {'B', 'M'};
  const auto put = [&](std::int64_t value, int count) {
    for (int k = 0; k < count; ++k) bytes.push_back(static_cast<std::uint8_t>(value >> (8 * k)));
  };
  const std::int64_t row_bytes = (3 * image.width + 3) / 4 * 4;
  for (const std::int64_t value : {54 + row_bytes * image.height, std::int64_t{0}, std::int64_t{54}, std::int64_t{40},
                                   std::int64_t{image.width}, std::int64_t{image.height}})
    put(value, 4);
  for (const int value : {1, 24}) put(value, 2);
  for (int k = 0; k < 6; ++k) put(0, 4);
  for (int y = image.height - 1; y >= 0; --y) {
    for (int x = 0; x < image.width; ++x) bytes.insert(bytes.end(), 3, image.at(x, y));
    bytes.resize(bytes.size() + static_cast<std::size_t>(row_bytes - 3 * image.width));
  }
  return bytes;
}

// The library that decodes would remark on a part of it on stderr.
TEST(ImageCodec, ABmpIsReadWholeOrNotAtAll) {
  const GrayImage image = ramp(37, 23);
  const std::vector<std::uint8_t> bytes = bmp_of(image);
  const auto whole = decode(bytes, "a.bmp");
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->image.pixels, image.pixels);
  ::testing::internal::CaptureStderr();
  for (std::size_t size = 0; size < bytes.size(); size += 7) {
    const auto part = decode(std::span(bytes.data(), size), "cut");
    ASSERT_FALSE(part) << size;
    EXPECT_EQ(part.error().code, ErrorCode::image_unreadable);
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
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

// The library that decodes would remark on these on stderr.
TEST(ImageCodec, ABrokenPngIsRefusedBeforeItIsDecoded) {
  const auto whole = encode_png(ramp(64, 64));
  ASSERT_TRUE(whole);
  ::testing::internal::CaptureStderr();
  for (std::size_t at = 8; at < whole->size(); at += 5) {
    auto bytes = *whole;
    bytes[at] ^= 0x41;
    EXPECT_FALSE(decode(bytes, "a.png")) << at;
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(ImageCodec, AHugeSizeInTheHeaderIsRefused) {
  auto bytes = encode_png(ramp(64, 64));
  ASSERT_TRUE(bytes);
  std::fill(bytes->begin() + 16, bytes->begin() + 24, std::uint8_t{0xff});  // 4294967295 x 4294967295
  const auto picture = decode(*bytes, "a.png");
  ASSERT_FALSE(picture);
  EXPECT_NE(picture.error().context.at("detail").find("100 megapixels"), std::string::npos);
}

std::vector<std::uint8_t> bytes_of(std::initializer_list<int> values, std::size_t size) {
  std::vector<std::uint8_t> out(values.begin(), values.end());
  out.resize(size, 0);
  return out;
}

// No decoder may take gigabytes for what 50 bytes claim.
TEST(ImageCodec, AHugeSizeIsRefusedInEveryFormat) {
  const std::vector<std::uint8_t> bmp =
      bytes_of({'B', 'M', 0, 0, 0, 0, 0, 0, 0, 0, 54, 0, 0, 0, 40, 0, 0, 0, 0x02, 0xfa, 0, 0, 0x03, 0x40}, 60);
  std::vector<std::uint8_t> upside_down = bmp;  // a height below zero
  upside_down[22] = 0x00, upside_down[23] = 0x80, upside_down[24] = 0xff, upside_down[25] = 0xff;
  // A comment, then the frame header with 65535 x 65535, then the end.
  const std::vector<std::uint8_t> jpeg = bytes_of(
      {0xff, 0xd8, 0xff, 0xfe, 0, 4, 'a', 'b', 0xff, 0xc0, 0, 17, 8, 0xff, 0xff, 0xff, 0xff, 3, 0xff, 0xd9}, 20);
  // One directory: 70000 x 70000, as numbers of 32 bits, the high byte first.
  const std::vector<std::uint8_t> tiff = bytes_of({'M', 'M', 0, 42,   0,    0, 0, 8, 0, 2, 1, 0, 0, 4, 0, 0,    0,
                                                   1,   0,   1, 0x11, 0x70, 1, 1, 0, 4, 0, 0, 0, 1, 0, 1, 0x11, 0x70},
                                                  40);
  for (const auto& file : {bmp, upside_down, jpeg, tiff}) {
    const auto picture = decode(file, "claims.much");
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().context.at("detail"), "the picture is larger than 100 megapixels");
  }
}

TEST(ImageCodec, OtherFilesAreNamed) {
  const std::vector<std::uint8_t> text{'h', 'e', 'l', 'l', 'o'};
  const auto result = decode(text, "notes.txt");
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().context.at("detail").find("not a PNG"), std::string::npos);
}

}  // namespace
}  // namespace zerodrift::vision
