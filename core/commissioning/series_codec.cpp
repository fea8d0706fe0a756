#include "core/commissioning/series_codec.h"

#include <zlib.h>

#include <bit>
#include <cstring>
#include <stdexcept>

namespace zerodrift::commissioning {

namespace {

constexpr std::size_t largest_ratio = 1032;  // of deflate (zlib's technical notes)
constexpr std::size_t least_bytes = 1024;

}  // namespace

static_assert(std::endian::native == std::endian::little, "samples are stored in little endian");

std::string encode_row(std::span<const double> row) {
  std::string bytes(row.size_bytes(), '\0');
  std::memcpy(bytes.data(), row.data(), bytes.size());
  return bytes;
}

bool decode_row(std::string_view bytes, std::size_t width, std::vector<double>& out) {
  if (bytes.size() != width * sizeof(double)) return false;
  const std::size_t start = out.size();
  out.resize(start + width);
  std::memcpy(out.data() + start, bytes.data(), bytes.size());
  return true;
}

std::string encode_chunk(std::span<const double> rows, std::size_t width) {
  const std::size_t count = rows.size() / width;
  std::vector<double> columns(rows.size());
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t column = 0; column < width; ++column) columns[column * count + row] = rows[row * width + column];
  }
  const uLong size = static_cast<uLong>(columns.size() * sizeof(double));
  std::string bytes(compressBound(size), '\0');
  uLongf used = bytes.size();
  const auto* source = reinterpret_cast<const Bytef*>(columns.data());
  if (compress2(reinterpret_cast<Bytef*>(bytes.data()), &used, source, size, Z_BEST_SPEED) != Z_OK) {
    throw std::runtime_error("deflate failed on a buffer of its own bound");
  }
  bytes.resize(used);
  return bytes;
}

bool decode_chunk(std::string_view bytes, std::size_t count, std::size_t width, std::vector<double>& out) {
  // What a file claims is believed only as far as deflate can go: nothing else bounds the memory asked for here.
  if (width == 0 || count > (bytes.size() * largest_ratio + least_bytes) / (width * sizeof(double))) return false;
  std::vector<double> columns(count * width);
  uLongf size = static_cast<uLongf>(columns.size() * sizeof(double));
  const uLongf expected = size;
  const auto* source = reinterpret_cast<const Bytef*>(bytes.data());
  if (uncompress(reinterpret_cast<Bytef*>(columns.data()), &size, source, static_cast<uLong>(bytes.size())) != Z_OK ||
      size != expected) {
    return false;
  }
  const std::size_t start = out.size();
  out.resize(start + columns.size());
  for (std::size_t row = 0; row < count; ++row) {
    for (std::size_t column = 0; column < width; ++column) {
      out[start + row * width + column] = columns[column * count + row];
    }
  }
  return true;
}

}  // namespace zerodrift::commissioning
