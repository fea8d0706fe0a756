#pragma once
// Pixel formats of GenICam (PFNC, and the packed formats of GigE Vision before it) to grey images of 8 bits. Monochrome
// of 8, 10, 12, 14 and 16 bits, unpacked or packed, and the four orders of the Bayer mosaic. GrayImage holds 8 bits:
// deeper values are scaled so that full scale becomes 255 and rounded, v * 255 / (2^bits - 1), as of a file of 16 bits.
// A mosaic becomes luminance by bilinear interpolation of its colours.

#include <cstdint>
#include <span>
#include <string>

#include "core/base/result.h"
#include "core/vision/image.h"

namespace zerodrift::vision {

/// Whether gray_from() reads this format (its number in PFNC).
bool is_readable_format(std::uint32_t format);
/// As in the standard, "Mono12Packed"; its number for another one.
std::string format_name(std::uint32_t format);

/// A picture as it lies in a camera's buffer: rows without gaps. camera_format without a url for a format that is not
/// read, data_does_not_fit when the bytes do not hold the picture.
Result<GrayImage> gray_from(std::span<const std::uint8_t> bytes, int width, int height, std::uint32_t format);

}  // namespace zerodrift::vision
