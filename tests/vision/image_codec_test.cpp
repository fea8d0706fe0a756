#include "core/vision/image_codec.h"

#include <gtest/gtest.h>

#include "core/base/hash.h"

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

struct PngPart {
  std::string name;
  std::vector<std::uint8_t> data;
};

std::vector<PngPart> parts_of(const std::vector<std::uint8_t>& png) {
  std::vector<PngPart> out;
  for (std::size_t at = 8; at + 12 <= png.size();) {
    const std::size_t length = png[at] << 24 | png[at + 1] << 16 | png[at + 2] << 8 | png[at + 3];
    const auto data = png.begin() + static_cast<std::ptrdiff_t>(at) + 8;
    out.push_back({std::string(data - 4, data), {data, data + static_cast<std::ptrdiff_t>(length)}});
    at += length + 12;
  }
  return out;
}

// With check sums that are right: only what stands in the chunks is wrong.
std::vector<std::uint8_t> png_of(const std::vector<PngPart>& parts) {
  std::vector<std::uint8_t> out{0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a};
  const auto number = [&](std::size_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) out.push_back(static_cast<std::uint8_t>(value >> shift));
  };
  for (const PngPart& part : parts) {
    number(part.data.size());
    const std::string named = part.name + std::string(part.data.begin(), part.data.end());
    out.insert(out.end(), named.begin(), named.end());
    number(crc32_of(named));
  }
  return out;
}

// The decoder would write its own lines on stderr: of rows that are broken, too short or too long, of a header that
// cannot be, of remarks in the file that do not concern the pixels.
TEST(ImageCodec, OnlyOurErrorAppearsForABrokenPng) {
  const GrayImage image = ramp(64, 64);
  const std::vector<PngPart> good = parts_of(*encode_png(image));
  ASSERT_EQ(good.front().name, "IHDR");
  ASSERT_EQ(good[1].name, "IDAT");
  ASSERT_EQ(good.size(), 3u);
  const auto with = [&](std::size_t part, auto change) {
    std::vector<PngPart> parts = good;
    change(parts[part].data);
    return png_of(parts);
  };
  ::testing::internal::CaptureStderr();
  const auto plain = decode(png_of(good), "a.png");
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->image.pixels, image.pixels);
  std::vector<PngPart> remarks = good;
  remarks.insert(remarks.begin() + 1, {{"iCCP", {'x', 0, 0, 'a'}}, {"gAMA", {0}}, {"tRNS", {1}}});
  const auto remarked = decode(png_of(remarks), "a.png");
  ASSERT_TRUE(remarked);
  EXPECT_EQ(remarked->image.pixels, image.pixels);
  std::vector<PngPart> after = good;
  after.insert(after.begin() + 2, {"IDAT", {1, 2, 3}});
  using Data = std::vector<std::uint8_t>;
  const std::vector<Data> broken{with(1, [](Data& d) { d.resize(d.size() / 2); }),
                                 with(1, [](Data& d) { d.clear(); }),
                                 with(1, [](Data& d) { d.back() ^= 1; }),
                                 with(1, [](Data& d) { d[0] = 0; }),
                                 with(0, [](Data& d) { d[7] = 80; }),
                                 with(0, [](Data& d) { d[7] = 40; }),
                                 with(0, [](Data& d) { d[3] = 0; }),
                                 with(0, [](Data& d) { d[8] = 7; }),
                                 with(0, [](Data& d) { d[9] = 3; }),
                                 with(0, [](Data& d) { d[9] = 9; }),
                                 with(0, [](Data& d) { d[10] = 1; }),
                                 with(0, [](Data& d) { d[12] = 1; }),
                                 with(0, [](Data& d) { d.pop_back(); }),
                                 png_of(after),
                                 png_of({good[0], {"ABCD", {}}, good[1], good[2]}),
                                 png_of({good[1], good[2]}),
                                 png_of({good[0], good[2]})};
  for (std::size_t k = 0; k < broken.size(); ++k) {
    const auto picture = decode(broken[k], "a.png");
    ASSERT_FALSE(picture) << k;
    EXPECT_EQ(picture.error().code, ErrorCode::image_unreadable) << k;
  }
  for (std::size_t at = 0; at < good[1].data.size(); ++at) {
    static_cast<void>(decode(with(1, [&](Data& d) { d[at] ^= 0x55; }), "a.png"));
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
