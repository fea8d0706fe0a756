#pragma once
// Image files and the bytes of a camera stream to grey images and back: PNG, JPEG, BMP and TIFF.
// Colour becomes luminance; 10 to 16 bits become 8 (the note says so). A file that ends early is an error, not half a
// picture.

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/vision/image.h"

namespace zerodrift::vision {

struct DecodedImage {
  GrayImage image;
  std::string note;  // what was converted, "" for an 8-bit grey image
};

/// quality 1 to 100.
Result<std::vector<std::uint8_t>> encode_jpeg(const GrayImage& image, int quality);
Result<std::vector<std::uint8_t>> encode_png(const GrayImage& image);
/// `name` is for the message only. Errors: image_unreadable.
Result<DecodedImage> decode(std::span<const std::uint8_t> bytes, const std::string& name);

Result<DecodedImage> read_image(const std::filesystem::path& path);
Status write_png(const std::filesystem::path& path, const GrayImage& image);

}  // namespace zerodrift::vision
