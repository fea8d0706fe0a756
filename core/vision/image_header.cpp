#include "core/vision/image_header.h"

#include <cstdlib>

namespace zerodrift::vision {
namespace {

using Bytes = std::span<const std::uint8_t>;

/// Numbers at places in a file; beyond its end they are not there.
class Reader {
 public:
  Reader(Bytes bytes, bool high_byte_first) : m_bytes(bytes), m_high_byte_first(high_byte_first) {}

  std::optional<std::int64_t> number(std::size_t at, std::size_t count) const {
    if (at > m_bytes.size() || count > m_bytes.size() - at) return std::nullopt;
    std::int64_t out = 0;
    for (std::size_t k = 0; k < count; ++k) out = out * 256 + m_bytes[m_high_byte_first ? at + k : at + count - 1 - k];
    return out;
  }

 private:
  Bytes m_bytes;
  bool m_high_byte_first;
};

std::optional<ClaimedSize> size_of(std::optional<std::int64_t> width, std::optional<std::int64_t> height) {
  if (!width || !height) return std::nullopt;
  return ClaimedSize{*width, *height};
}

std::optional<ClaimedSize> bmp_size(Bytes bytes) {
  const Reader in(bytes, false);
  const auto header_bytes = in.number(14, 4);
  if (!header_bytes) return std::nullopt;
  if (*header_bytes == 12) return size_of(in.number(18, 2), in.number(20, 2));
  const auto size = size_of(in.number(18, 4), in.number(22, 4));
  if (!size) return std::nullopt;
  // Both have a sign; a height below zero says that the rows begin at the top.
  return ClaimedSize{std::abs(std::int64_t{static_cast<std::int32_t>(size->width)}),
                     std::abs(std::int64_t{static_cast<std::int32_t>(size->height)})};
}

std::optional<ClaimedSize> jpeg_size(Bytes bytes) {
  const Reader in(bytes, true);
  std::size_t at = 2;
  while (const auto mark = in.number(at, 2)) {
    const std::int64_t kind = *mark - 0xff00;
    if (kind == 0xff) {  // a byte to fill up
      ++at;
      continue;
    }
    if (kind < 0xc0) return std::nullopt;
    const bool frame = kind <= 0xcf && kind != 0xc4 && kind != 0xc8 && kind != 0xcc;
    if (frame) return size_of(in.number(at + 7, 2), in.number(at + 5, 2));
    const bool alone = kind >= 0xd0 && kind <= 0xd8;
    const auto length = alone ? std::optional<std::int64_t>(0) : in.number(at + 2, 2);
    if (!length) return std::nullopt;
    at += 2 + static_cast<std::size_t>(*length);
  }
  return std::nullopt;
}

std::optional<ClaimedSize> tiff_size(Bytes bytes) {
  const Reader in(bytes, bytes[0] == 'M');
  const auto directory = in.number(4, 4);
  const auto entries = directory ? in.number(static_cast<std::size_t>(*directory), 2) : std::nullopt;
  std::optional<std::int64_t> width, height;
  for (std::int64_t k = 0; entries && k < *entries; ++k) {
    const auto at = static_cast<std::size_t>(*directory + 2 + 12 * k);
    const auto tag = in.number(at, 2);
    const auto type = in.number(at + 2, 2);
    if (!tag || !type) break;
    if (*tag != 256 && *tag != 257) continue;
    constexpr std::int64_t of_two_bytes = 3;
    (*tag == 256 ? width : height) = in.number(at + 8, *type == of_two_bytes ? 2 : 4);
  }
  return size_of(width, height);
}

}  // namespace

std::optional<ClaimedSize> claimed_size(Bytes bytes) {
  if (bytes.size() < 8) return std::nullopt;
  if (bytes[0] == 0x89 && bytes[1] == 'P') {
    const Reader in(bytes, true);
    return size_of(in.number(16, 4), in.number(20, 4));
  }
  if (bytes[0] == 0xff && bytes[1] == 0xd8) return jpeg_size(bytes);
  if (bytes[0] == 'B' && bytes[1] == 'M') return bmp_size(bytes);
  if (bytes[0] == bytes[1] && (bytes[0] == 'I' || bytes[0] == 'M')) return tiff_size(bytes);
  return std::nullopt;
}

std::optional<std::int64_t> claimed_bytes_of_bmp(Bytes bytes) {
  if (bytes.size() < 2 || bytes[0] != 'B' || bytes[1] != 'M') return std::nullopt;
  const Reader in(bytes, false);
  const auto size = bmp_size(bytes);
  const auto pixels_at = in.number(10, 4);
  const auto pixel_bits = in.number(28, 2);
  const auto compression = in.number(30, 4);
  constexpr std::int64_t both_headers_bytes = 54;
  constexpr std::int64_t old_header_bytes = 12;
  if (in.number(14, 4) == old_header_bytes) return std::nullopt;
  if (!size || !pixels_at || !pixel_bits || !compression) return both_headers_bytes;
  if (*compression != 0) return std::nullopt;
  const std::int64_t row_bytes = (size->width * *pixel_bits + 31) / 32 * 4;
  return *pixels_at + row_bytes * size->height;
}

}  // namespace zerodrift::vision
