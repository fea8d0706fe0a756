#include "core/vision/pixel_format.h"

#include <gtest/gtest.h>

#include <random>

namespace zerodrift::vision {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::vector<std::uint8_t> pixels_of(const Bytes& bytes, int width, int height, std::uint32_t format) {
  const auto image = gray_from(bytes, width, height, format);
  EXPECT_TRUE(image) << format_name(format) << ": " << describe(image.error());
  return image ? image->pixels : Bytes{};
}

// Values by hand from the drawings of the standards: 0x123 and 0xABC of 12 bits, 0x048 and 0x2AF of 10.
TEST(PixelFormat, PackedValuesAreTakenApartAsTheStandardDrawsThem) {
  const auto scaled = [](unsigned value, unsigned full) {
    return static_cast<std::uint8_t>((value * 255U + full / 2U) / full);
  };
  const Bytes twelve{scaled(0x123, 4095), scaled(0xABC, 4095)};
  EXPECT_EQ(pixels_of({0x23, 0x01, 0xBC, 0x0A}, 2, 1, 0x01100005), twelve) << "Mono12";
  EXPECT_EQ(pixels_of({0x12, 0xC3, 0xAB}, 2, 1, 0x010C0006), twelve) << "Mono12Packed";
  EXPECT_EQ(pixels_of({0x23, 0xC1, 0xAB}, 2, 1, 0x010C0047), twelve) << "Mono12p";
  const Bytes ten{scaled(0x048, 1023), scaled(0x2AF, 1023)};
  EXPECT_EQ(pixels_of({0x48, 0x00, 0xAF, 0x02}, 2, 1, 0x01100003), ten) << "Mono10";
  EXPECT_EQ(pixels_of({0x12, 0x30, 0xAB}, 2, 1, 0x010C0004), ten) << "Mono10Packed";
  EXPECT_EQ(pixels_of({0x48, 0xBC, 0x0A}, 2, 1, 0x010A0046), ten) << "Mono10p";
  EXPECT_EQ(pixels_of({0x34, 0x12}, 1, 1, 0x01100007), (Bytes{scaled(0x1234, 65535)})) << "Mono16";
  EXPECT_EQ(pixels_of({7, 200, 255}, 3, 1, 0x01080001), (Bytes{7, 200, 255})) << "Mono8";
}

TEST(PixelFormat, NothingStaysBlackAndFullScaleStaysSaturated) {
  for (const std::uint32_t format :
       {0x01100003U, 0x010C0004U, 0x010A0046U, 0x01100005U, 0x010C0006U, 0x010C0047U, 0x01100025U, 0x01100007U}) {
    EXPECT_EQ(pixels_of(Bytes(64, 0x00), 4, 4, format), Bytes(16, 0)) << format_name(format);
    EXPECT_EQ(pixels_of(Bytes(64, 0xFF), 4, 4, format), Bytes(16, 255)) << format_name(format);
  }
}

// The order of the colours decides which weight each pixel has: a picture of one colour tells it.
TEST(PixelFormat, AMosaicBecomesLuminanceInEachOfItsOrders) {
  const auto mosaic = [](const char* order, char colour) {
    Bytes bytes(64);
    for (std::size_t i = 0; i < 64; ++i) bytes[i] = order[(i / 8 % 2) * 2 + i % 2] == colour ? 200 : 0;
    return bytes;
  };
  const std::pair<std::uint32_t, const char*> orders[] = {
      {0x01080008, "GRBG"}, {0x01080009, "RGGB"}, {0x0108000A, "GBRG"}, {0x0108000B, "BGGR"}};
  const std::pair<char, double> weights[] = {{'R', 0.299}, {'G', 0.587}, {'B', 0.114}};
  for (const auto& [format, order] : orders) {
    for (const auto& [colour, weight] : weights) {
      const auto pixels = pixels_of(mosaic(order, colour), 8, 8, format);
      for (const int x : {3, 4}) EXPECT_NEAR(pixels[3 * 8 + x], 200.0 * weight, 1.0) << order << " " << colour;
    }
    EXPECT_EQ(pixels_of(Bytes(64, 90), 8, 8, format), Bytes(64, 90)) << order << ": grey stays grey";
  }
  EXPECT_EQ(pixels_of(Bytes(128, 0xFF), 8, 8, 0x01100011), Bytes(64, 255)) << "BayerRG12";
}

TEST(PixelFormat, WhatIsNotReadOrTooShortIsRefused) {
  EXPECT_FALSE(is_readable_format(0x02180014)) << "RGB8";
  const auto colour = gray_from(Bytes(300), 10, 10, 0x02180014);
  ASSERT_FALSE(colour);
  EXPECT_EQ(colour.error().code, ErrorCode::camera_format);
  EXPECT_EQ(colour.error().context.at("found"), "0x02180014");
  EXPECT_EQ(format_name(0x010C0006), "Mono12Packed");
  for (const std::uint32_t format : {0x01080001U, 0x01100003U, 0x010C0004U, 0x010A0046U, 0x010C0047U, 0x01080009U}) {
    EXPECT_TRUE(is_readable_format(format));
    const auto bytes_needed = (101U * 3U * ((format >> 16U) & 0xFFU) + 7U) / 8U;
    EXPECT_TRUE(gray_from(Bytes(bytes_needed), 101, 3, format)) << format_name(format);
    EXPECT_FALSE(gray_from(Bytes(bytes_needed - 1), 101, 3, format)) << format_name(format);
    for (const auto& [width, height] : {std::pair{0, 5}, {5, 0}, {-1, 5}, {2147483647, 2147483647}}) {
      EXPECT_FALSE(gray_from(Bytes(100), width, height, format)) << format_name(format);
    }
  }
  EXPECT_FALSE(gray_from(Bytes(100), 1, 100, 0x01080009)) << "a mosaic of one column";
}

}  // namespace
}  // namespace zerodrift::vision
