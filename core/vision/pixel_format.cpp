#include "core/vision/pixel_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

enum class Packing {
  none,        // one or two bytes a value, the low byte first
  shared_low,  // GigE Vision "Packed": two values in three bytes, the middle one has the low bits of both
  contiguous,  // PFNC "p": bit after bit, the low ones first
};

constexpr int no_mosaic = -1;

struct Format {
  std::uint32_t number;
  const char* name;
  int bits;
  Packing packing;
  int mosaic;  // OpenCV's code to luminance
};

// OpenCV names a mosaic after the second row's second and third pixel, the standard after the first row's first two.
constexpr int gr = cv::COLOR_BayerGB2GRAY;
constexpr int rg = cv::COLOR_BayerBG2GRAY;
constexpr int gb = cv::COLOR_BayerGR2GRAY;
constexpr int bg = cv::COLOR_BayerRG2GRAY;

// EMVA, Pixel Format Naming Convention 2.1 (numbers), and GigE Vision 1.2 (the packed ones).
constexpr std::array formats = {
    Format{0x01080001, "Mono8", 8, Packing::none, no_mosaic},
    Format{0x01100003, "Mono10", 10, Packing::none, no_mosaic},
    Format{0x010C0004, "Mono10Packed", 10, Packing::shared_low, no_mosaic},
    Format{0x010A0046, "Mono10p", 10, Packing::contiguous, no_mosaic},
    Format{0x01100005, "Mono12", 12, Packing::none, no_mosaic},
    Format{0x010C0006, "Mono12Packed", 12, Packing::shared_low, no_mosaic},
    Format{0x010C0047, "Mono12p", 12, Packing::contiguous, no_mosaic},
    Format{0x01100025, "Mono14", 14, Packing::none, no_mosaic},
    Format{0x01100007, "Mono16", 16, Packing::none, no_mosaic},
    Format{0x01080008, "BayerGR8", 8, Packing::none, gr},
    Format{0x01080009, "BayerRG8", 8, Packing::none, rg},
    Format{0x0108000A, "BayerGB8", 8, Packing::none, gb},
    Format{0x0108000B, "BayerBG8", 8, Packing::none, bg},
    Format{0x0110000C, "BayerGR10", 10, Packing::none, gr},
    Format{0x0110000D, "BayerRG10", 10, Packing::none, rg},
    Format{0x0110000E, "BayerGB10", 10, Packing::none, gb},
    Format{0x0110000F, "BayerBG10", 10, Packing::none, bg},
    Format{0x01100010, "BayerGR12", 12, Packing::none, gr},
    Format{0x01100011, "BayerRG12", 12, Packing::none, rg},
    Format{0x01100012, "BayerGB12", 12, Packing::none, gb},
    Format{0x01100013, "BayerBG12", 12, Packing::none, bg},
    Format{0x010C002A, "BayerGR12Packed", 12, Packing::shared_low, gr},
    Format{0x010C002B, "BayerRG12Packed", 12, Packing::shared_low, rg},
    Format{0x010C002C, "BayerGB12Packed", 12, Packing::shared_low, gb},
    Format{0x010C002D, "BayerBG12Packed", 12, Packing::shared_low, bg},
    Format{0x010C0055, "BayerGB12p", 12, Packing::contiguous, gb},
    Format{0x010C0057, "BayerGR12p", 12, Packing::contiguous, gr},
    Format{0x010C0059, "BayerRG12p", 12, Packing::contiguous, rg},
    Format{0x010C0053, "BayerBG12p", 12, Packing::contiguous, bg},
};

const Format* find_format(std::uint32_t number) {
  const auto at = std::find_if(formats.begin(), formats.end(), [&](const Format& f) { return f.number == number; });
  return at == formats.end() ? nullptr : &*at;
}

std::size_t bytes_of(const Format& format, std::size_t pixels) {
  switch (format.packing) {
    case Packing::none:
      return format.bits == 8 ? pixels : 2 * pixels;
    case Packing::shared_low:
      return (3 * pixels + 1) / 2;
    case Packing::contiguous:
      return (pixels * static_cast<std::size_t>(format.bits) + 7) / 8;
  }
  return 0;
}

unsigned value_at(const Format& format, std::span<const std::uint8_t> bytes, std::size_t pixel) {
  const auto byte = [&](std::size_t at) { return at < bytes.size() ? unsigned{bytes[at]} : 0U; };
  const unsigned mask = (1U << format.bits) - 1U;
  switch (format.packing) {
    case Packing::none:
      return format.bits == 8 ? byte(pixel) : (byte(2 * pixel) | byte(2 * pixel + 1) << 8U) & mask;
    case Packing::shared_low: {
      const std::size_t first = pixel / 2 * 3;
      const unsigned low_bits = static_cast<unsigned>(format.bits) - 8U;
      const bool second = pixel % 2 == 1;
      const unsigned low = (byte(first + 1) >> (second ? 4U : 0U)) & ((1U << low_bits) - 1U);
      return byte(second ? first + 2 : first) << low_bits | low;
    }
    case Packing::contiguous: {
      const std::size_t bit = pixel * static_cast<std::size_t>(format.bits);
      const unsigned three = byte(bit / 8) | byte(bit / 8 + 1) << 8U | byte(bit / 8 + 2) << 16U;
      return (three >> (bit % 8)) & mask;
    }
  }
  return 0;
}

}  // namespace

bool is_readable_format(std::uint32_t format) {
  return find_format(format) != nullptr;
}

std::string format_name(std::uint32_t format) {
  const Format* known = find_format(format);
  return known != nullptr ? known->name : fmt::format("0x{:08X}", format);
}

Result<GrayImage> gray_from(std::span<const std::uint8_t> bytes, int width, int height, std::uint32_t format) {
  const Format* known = find_format(format);
  if (known == nullptr) {
    return fail(ErrorCode::camera_format, {{"found", format_name(format)}, {"expected", "Mono8, Mono12, BayerRG8"}});
  }
  const std::size_t pixels =
      width > 0 && height > 0 ? static_cast<std::size_t>(width) * static_cast<std::size_t>(height) : 0;
  if (pixels == 0 || bytes.size() < bytes_of(*known, pixels)) {
    return fail(ErrorCode::data_does_not_fit, {{"what", "picture of the camera"},
                                               {"found", fmt::format("{} bytes", bytes.size())},
                                               {"expected", fmt::format("{} bytes", bytes_of(*known, pixels))}});
  }
  GrayImage image{width, height, std::vector<std::uint8_t>(pixels)};
  if (known->bits == 8) {
    std::copy_n(bytes.begin(), pixels, image.pixels.begin());
  } else {
    const unsigned full = (1U << known->bits) - 1U;
    for (std::size_t i = 0; i < pixels; ++i) {
      image.pixels[i] = static_cast<std::uint8_t>((value_at(*known, bytes, i) * 255U + full / 2U) / full);
    }
  }
  if (known->mosaic == no_mosaic) return image;
  if (width < 2 || height < 2) {
    return fail(ErrorCode::data_does_not_fit, {{"what", "picture of the camera"},
                                               {"found", fmt::format("{} x {} pixels", width, height)},
                                               {"expected", "2 x 2 pixels or more"}});
  }
  cv::Mat gray;
  cv::cvtColor(mat_view(image), gray, known->mosaic);
  return gray_from_mat(gray);
}

}  // namespace zerodrift::vision
