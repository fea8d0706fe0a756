#pragma once
// A PNG file (ISO/IEC 15948) looked through before the decoder has it, which writes what it dislikes on standard error.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zerodrift::vision {

struct PlainPng {
  std::string fault;                // "" when the picture is whole
  std::vector<std::uint8_t> bytes;  // of the same picture, without the chunks that do not change its pixels
};

/// Chunks with their check sums, header, and the compressed rows to the last byte.
PlainPng plain_png(std::span<const std::uint8_t> bytes);

}  // namespace zerodrift::vision
