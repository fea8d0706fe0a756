#pragma once
// An 8-bit grey PNG (ISO/IEC 15948) by zlib alone, so that test images do not pass through the codec under test.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "tests/support/frame_renderer.h"

namespace zerodrift::test_support {

std::vector<std::uint8_t> png_bytes(const Frame& frame);
/// Throws std::runtime_error when the file cannot be written.
void write_png(const std::filesystem::path& path, const Frame& frame);

}  // namespace zerodrift::test_support
