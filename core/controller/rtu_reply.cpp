#include "core/controller/rtu_reply.h"

#include <fmt/format.h>

#include <algorithm>

namespace zerodrift::controller {
namespace {

constexpr std::size_t crc_bytes = 2;
constexpr int exception_bit = 0x80;
constexpr int function_write_single = 6;

/// Of a reply with its CRC, from its first bytes; 0: not told yet.
std::size_t reply_size(std::span<const std::uint8_t> reply, bool& known) {
  known = true;
  if (reply.size() < 2) return 0;
  const int function = reply[1];
  if ((function & exception_bit) != 0) return 3 + crc_bytes;
  if (function == 3 || function == 4) return reply.size() < 3 ? 0 : 3 + reply[2] + crc_bytes;
  if (function == function_write_single || function == 16) return 6 + crc_bytes;
  known = false;
  return 0;
}

}  // namespace

std::uint16_t rtu_crc(std::span<const std::uint8_t> bytes) {
  std::uint16_t crc = 0xFFFF;
  for (const std::uint8_t byte : bytes) {
    crc = static_cast<std::uint16_t>(crc ^ byte);
    for (int bit = 0; bit < 8; ++bit) crc = static_cast<std::uint16_t>((crc & 1) != 0 ? (crc >> 1) ^ 0xA001 : crc >> 1);
  }
  return crc;
}

void append_rtu_crc(std::vector<std::uint8_t>& frame) {
  const std::uint16_t crc = rtu_crc(frame);
  frame.push_back(static_cast<std::uint8_t>(crc & 0xFF));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8));
}

RtuReply::State RtuReply::add(std::span<const std::uint8_t> bytes) {
  m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
  return m_state = look();
}

RtuReply::State RtuReply::spoilt(std::string detail) {
  m_detail = std::move(detail);
  return State::spoilt;
}

RtuReply::State RtuReply::look() {
  for (;;) {
    // No unit has the number 0.
    for (; m_start < m_bytes.size() && m_bytes[m_start] == 0; ++m_start) m_zeros = true;
    const auto rest = std::span<const std::uint8_t>(m_bytes).subspan(m_start);
    if (m_echo == LocalEcho::none || m_echo_dropped) break;
    const auto beginning = rest.first(std::min(rest.size(), m_request.size()));
    if (!std::equal(beginning.begin(), beginning.end(), m_request.begin())) break;
    if (beginning.size() < m_request.size()) return State::incomplete;
    m_start += m_request.size();
    m_echo_dropped = true;
    m_echo = LocalEcho::heard;
  }
  const auto rest = std::span<const std::uint8_t>(m_bytes).subspan(m_start);
  bool known = true;
  m_size = reply_size(rest, known);
  if (!known) return spoilt(fmt::format("function {} instead of {}", rest[1], m_request[1]));
  if (m_size == 0 || rest.size() < m_size) return State::incomplete;
  const auto whole = rest.first(m_size);
  const std::uint16_t crc = rtu_crc(whole.first(m_size - crc_bytes));
  if (whole[m_size - 2] != (crc & 0xFF) || whole[m_size - 1] != crc >> 8) return spoilt("check sum wrong");
  // The reply to function 6 looks like an echo, so that it tells nothing.
  if (m_echo == LocalEcho::unknown && m_request[1] != function_write_single) m_echo = LocalEcho::none;
  return State::whole;
}

std::span<const std::uint8_t> RtuReply::frame() const {
  return std::span<const std::uint8_t>(m_bytes).subspan(m_start, m_size - crc_bytes);
}

}  // namespace zerodrift::controller
