#include "core/vision/png_check.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <bit>
#include <optional>
#include <string_view>

#include "core/base/hash.h"

namespace zerodrift::vision {
namespace {

using Bytes = std::span<const std::uint8_t>;

const char* const png_damaged = "the PNG file is damaged";
const char* const png_ends_early = "the PNG file ends early";
constexpr std::size_t signature_bytes = 8;
constexpr std::size_t around_bytes = 12;  // length, name and check sum of a chunk
constexpr std::uint8_t last_filter = 4;
constexpr std::size_t longest_side = 1'000'000;  // that the decoder takes

std::size_t number_at(Bytes bytes, std::size_t at) {
  return std::size_t{bytes[at]} << 24 | std::size_t{bytes[at + 1]} << 16 | std::size_t{bytes[at + 2]} << 8 |
         bytes[at + 3];
}

struct Chunk {
  std::string_view name;
  Bytes data;
  Bytes whole;
};

struct Header {
  std::size_t width, height;
  int depth, colour;
  bool interlaced;
};

std::optional<Header> header_in(Bytes data) {
  if (data.size() != 13 || data[10] != 0 || data[11] != 0 || data[12] > 1) return std::nullopt;
  const Header out{number_at(data, 0), number_at(data, 4), data[8], data[9], data[12] == 1};
  // Depths that each colour type may have, as a sum of them: they are powers of two.
  constexpr std::array<int, 7> depths{1 + 2 + 4 + 8 + 16, 0, 8 + 16, 1 + 2 + 4 + 8, 8 + 16, 0, 8 + 16};
  if (std::min(out.width, out.height) == 0 || std::max(out.width, out.height) > longest_side || out.colour > 6 ||
      !std::has_single_bit(unsigned(out.depth)) || (depths[static_cast<std::size_t>(out.colour)] & out.depth) == 0) {
    return std::nullopt;
  }
  return out;
}

// Rows that follow each other with as many bytes each, the filter's among them.
struct Rows {
  std::size_t count, bytes;
};

std::vector<Rows> compressed_rows(const Header& header) {
  constexpr std::array<int, 7> samples{1, 0, 3, 1, 2, 0, 4};
  const std::size_t bits = static_cast<std::size_t>(header.depth) *
                           static_cast<std::size_t>(samples[static_cast<std::size_t>(header.colour)]);
  const auto row_bytes = [&](std::size_t width) { return 1 + (width * bits + 7) / 8; };
  if (!header.interlaced) return {{header.height, row_bytes(header.width)}};
  struct Pass {
    std::size_t x, y, every_x, every_y;
  };
  std::vector<Rows> out;
  for (const Pass& pass : {Pass{0, 0, 8, 8}, Pass{4, 0, 8, 8}, Pass{0, 4, 4, 8}, Pass{2, 0, 4, 4}, Pass{0, 2, 2, 4},
                           Pass{1, 0, 2, 2}, Pass{0, 1, 1, 2}}) {
    const std::size_t width = (header.width + pass.every_x - 1 - pass.x) / pass.every_x;
    const std::size_t height = (header.height + pass.every_y - 1 - pass.y) / pass.every_y;
    if (width > 0 && height > 0) out.push_back({height, row_bytes(width)});
  }
  return out;
}

/// Counts off the rows as they come out of the decompression.
class RowCounter {
 public:
  explicit RowCounter(std::vector<Rows> rows) : m_rows(std::move(rows)) {}

  bool take(Bytes bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      if (m_part == m_rows.size()) return false;
      if (m_in_row == 0 && bytes[at] > last_filter) return false;
      const std::size_t step = std::min(bytes.size() - at, m_rows[m_part].bytes - m_in_row);
      at += step;
      m_in_row += step;
      if (m_in_row < m_rows[m_part].bytes) break;
      m_in_row = 0;
      if (++m_row == m_rows[m_part].count) m_row = 0, ++m_part;
    }
    return true;
  }
  bool complete() const { return m_part == m_rows.size(); }

 private:
  std::vector<Rows> m_rows;
  std::size_t m_part = 0, m_row = 0, m_in_row = 0;
};

bool holds_its_rows(const std::vector<Chunk>& parts, const Header& header) {
  RowCounter rows(compressed_rows(header));
  std::vector<std::uint8_t> out(std::size_t{1} << 16);
  z_stream stream{};
  if (inflateInit2(&stream, 0) != Z_OK) return false;
  int state = Z_OK;
  bool good = true;
  for (const Chunk& part : parts) {
    if (part.data.empty()) continue;
    good = good && state == Z_OK;
    if (!good) break;
    stream.next_in = const_cast<std::uint8_t*>(part.data.data());
    stream.avail_in = static_cast<unsigned>(part.data.size());
    do {
      stream.next_out = out.data();
      stream.avail_out = static_cast<unsigned>(out.size());
      state = inflate(&stream, Z_NO_FLUSH);
      if (state == Z_BUF_ERROR) state = Z_OK;  // it wants the next part
      good = (state == Z_OK || state == Z_STREAM_END) && rows.take({out.data(), out.size() - stream.avail_out});
    } while (good && state == Z_OK && stream.avail_out == 0);
    good = good && stream.avail_in == 0;
  }
  inflateEnd(&stream);
  return good && state == Z_STREAM_END && rows.complete();
}

// The chunks up to the end mark; a fault in words otherwise.
std::string chunks_in(Bytes bytes, std::vector<Chunk>& out) {
  for (std::size_t at = signature_bytes; at + around_bytes <= bytes.size();) {
    const std::size_t length = number_at(bytes, at);
    if (length > bytes.size() - at - around_bytes) break;
    const std::string_view named(reinterpret_cast<const char*>(bytes.data()) + at + 4, 4 + length);
    if (crc32_of(named) != number_at(bytes, at + 8 + length)) return png_damaged;
    out.push_back({named.substr(0, 4), bytes.subspan(at + 8, length), bytes.subspan(at, length + around_bytes)});
    if (out.back().name == "IEND") return "";
    at += around_bytes + length;
  }
  return png_ends_early;
}

// Of the palette's transparency and of a colour that stands for it.
bool transparency_fits(const Chunk& chunk, const Header& header, std::size_t palette_bytes) {
  if (header.colour == 0) return chunk.data.size() == 2;
  if (header.colour == 2) return chunk.data.size() == 6;
  return header.colour == 3 && !chunk.data.empty() && 3 * chunk.data.size() <= palette_bytes;
}

}  // namespace

PlainPng plain_png(Bytes bytes) {
  std::vector<Chunk> chunks;
  if (const std::string fault = chunks_in(bytes, chunks); !fault.empty()) return {fault, {}};
  const PlainPng damaged{png_damaged, {}};
  const auto header = chunks.front().name == "IHDR" ? header_in(chunks.front().data) : std::nullopt;
  if (!header) return damaged;
  PlainPng out{"", {bytes.begin(), bytes.begin() + signature_bytes}};
  std::vector<Chunk> pixels;
  std::size_t palette_bytes = 0;
  bool pixels_ended = false;
  for (std::size_t k = 0; k < chunks.size(); ++k) {
    const Chunk& chunk = chunks[k];
    pixels_ended = pixels_ended || (!pixels.empty() && chunk.name != "IDAT");
    bool kept = chunk.name == "IEND" || (chunk.name == "IHDR" && k == 0);
    if (chunk.name == "IDAT") {
      if (pixels_ended) return damaged;
      pixels.push_back(chunk);
      kept = true;
    } else if (chunk.name == "PLTE") {
      const std::size_t size = chunk.data.size();
      if (palette_bytes > 0 || !pixels.empty() || size == 0 || size % 3 != 0 || size > 768) return damaged;
      palette_bytes = size;
      kept = header->colour == 3;
      if (kept && size > std::size_t{3} << header->depth) return damaged;
    } else if (chunk.name == "tRNS") {
      kept = pixels.empty() && transparency_fits(chunk, *header, palette_bytes);
    } else if (!kept && chunk.name[0] >= 'A' && chunk.name[0] <= 'Z') {
      return damaged;  // one that a reader must know
    }
    if (kept) out.bytes.insert(out.bytes.end(), chunk.whole.begin(), chunk.whole.end());
  }
  if ((header->colour == 3 && palette_bytes == 0) || !holds_its_rows(pixels, *header)) return damaged;
  return out;
}

}  // namespace zerodrift::vision
