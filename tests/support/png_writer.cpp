#include "tests/support/png_writer.h"

#include <zlib.h>

#include <fstream>
#include <stdexcept>
#include <string_view>

namespace zerodrift::test_support {
namespace {

void append_uint32(std::vector<std::uint8_t>& bytes, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) bytes.push_back(static_cast<std::uint8_t>(value >> shift));
}

void append_chunk(std::vector<std::uint8_t>& bytes, std::string_view type, const std::vector<std::uint8_t>& data) {
  append_uint32(bytes, static_cast<std::uint32_t>(data.size()));
  const std::size_t checked_from = bytes.size();
  bytes.insert(bytes.end(), type.begin(), type.end());
  bytes.insert(bytes.end(), data.begin(), data.end());
  const auto checksum = crc32(0, bytes.data() + checked_from, static_cast<uInt>(bytes.size() - checked_from));
  append_uint32(bytes, static_cast<std::uint32_t>(checksum));
}

}  // namespace

std::vector<std::uint8_t> png_bytes(const Frame& frame) {
  std::vector<std::uint8_t> rows;
  rows.reserve(frame.pixels.size() + static_cast<std::size_t>(frame.height_px));
  for (int y = 0; y < frame.height_px; ++y) {
    rows.push_back(0);  // no row filter
    const auto row = frame.pixels.begin() + static_cast<std::ptrdiff_t>(y) * frame.width_px;
    rows.insert(rows.end(), row, row + frame.width_px);
  }
  uLongf size = compressBound(static_cast<uLong>(rows.size()));
  std::vector<std::uint8_t> packed(size);
  if (compress2(packed.data(), &size, rows.data(), static_cast<uLong>(rows.size()), 1) != Z_OK) {
    throw std::runtime_error("zlib failed");
  }
  packed.resize(size);
  std::vector<std::uint8_t> header;
  append_uint32(header, static_cast<std::uint32_t>(frame.width_px));
  append_uint32(header, static_cast<std::uint32_t>(frame.height_px));
  header.insert(header.end(), {8, 0, 0, 0, 0});  // 8 bits, grey, deflate, adaptive filters, not interlaced
  std::vector<std::uint8_t> bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};
  append_chunk(bytes, "IHDR", header);
  append_chunk(bytes, "IDAT", packed);
  append_chunk(bytes, "IEND", {});
  return bytes;
}

void write_png(const std::filesystem::path& path, const Frame& frame) {
  const std::vector<std::uint8_t> bytes = png_bytes(frame);
  std::ofstream stream(path, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!stream) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace zerodrift::test_support
