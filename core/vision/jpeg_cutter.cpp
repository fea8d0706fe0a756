#include "core/vision/jpeg_cutter.h"

namespace zerodrift::vision {
namespace {

constexpr std::size_t largest_picture = std::size_t{64} << 20;
constexpr std::string_view start_mark = "\xFF\xD8\xFF";
constexpr unsigned mark = 0xFF, start_of_image = 0xD8, end_of_image = 0xD9, start_of_scan = 0xDA;

/// Within coded data: a stuffed byte or a restart, which end nothing.
bool is_data(unsigned code) {
  return code == 0x00 || (code >= 0xD0 && code <= 0xD7);
}

}  // namespace

void JpegCutter::add(std::string_view bytes) {
  m_bytes += bytes;
}

void JpegCutter::drop(std::size_t count) {
  m_bytes.erase(0, count);
  m_at = 0;
  m_coded = false;
}

bool JpegCutter::find_start() {
  if (m_at > 0) return true;
  const std::size_t start = m_bytes.find(start_mark);
  if (start == std::string::npos) {
    if (m_bytes.size() > 2) drop(m_bytes.size() - 2);  // the beginning of a start may be there
    return false;
  }
  drop(start);
  m_at = 2;
  return true;
}

std::optional<std::string> JpegCutter::next() {
  const auto byte = [this](std::size_t at) { return static_cast<unsigned char>(m_bytes[at]); };
  while (find_start()) {
    if (m_at > largest_picture) {
      drop(2);
      continue;
    }
    if (m_coded) {
      while (m_at + 1 < m_bytes.size() && (byte(m_at) != mark || is_data(byte(m_at + 1)) || byte(m_at + 1) == mark)) {
        ++m_at;
      }
    }
    if (m_at + 1 >= m_bytes.size()) return std::nullopt;
    const unsigned code = byte(m_at + 1);
    if (byte(m_at) != mark || code == start_of_image) {
      drop(2);  // broken off: another picture may have begun since
      continue;
    }
    if (code == end_of_image) {
      std::string picture = m_bytes.substr(0, m_at + 2);
      drop(m_at + 2);
      return picture;
    }
    if (code == mark) {  // a fill byte
      ++m_at;
      continue;
    }
    if (m_at + 3 >= m_bytes.size()) return std::nullopt;
    const std::size_t length = byte(m_at + 2) * 256U + byte(m_at + 3);
    if (length < 2) {
      drop(2);
      continue;
    }
    if (m_at + 2 + length > m_bytes.size()) return std::nullopt;
    m_at += 2 + length;
    m_coded = code == start_of_scan;
  }
  return std::nullopt;
}

}  // namespace zerodrift::vision
