#pragma once
// The sizes that a picture file claims, read before a decoder takes memory for it.

#include <cstdint>
#include <optional>
#include <span>

namespace zerodrift::vision {

struct ClaimedSize {
  std::int64_t width = 0;
  std::int64_t height = 0;
};

/// PNG (IHDR), JPEG (the first frame header, ITU-T T.81 B.2.2), BMP (both headers) and TIFF 6.0 (tags 256 and 257 of
/// the first directory); nothing where the file is too short to say, or is none of these.
std::optional<ClaimedSize> claimed_size(std::span<const std::uint8_t> bytes);

/// Bytes that a BMP file of uncompressed pixels has to have; nothing of any other file.
std::optional<std::int64_t> claimed_bytes_of_bmp(std::span<const std::uint8_t> bytes);

}  // namespace zerodrift::vision
