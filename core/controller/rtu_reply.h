#pragma once
// A Modbus RTU reply among the bytes of a serial line. Before it there may be what belongs to no frame: zero bytes of a
// line that changes its direction, and the request itself, where an RS-485 adapter hears what it sends (local echo).

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace zerodrift::controller {

enum class LocalEcho {
  unknown,
  none,
  heard,
};

/// CRC-16 of Modbus over serial line V1.02, clause 6.2.2.
std::uint16_t rtu_crc(std::span<const std::uint8_t> bytes);
/// Low byte first, as on the line.
void append_rtu_crc(std::vector<std::uint8_t>& frame);

class RtuReply {
 public:
  enum class State {
    incomplete,
    whole,
    spoilt,  // detail() says how
  };

  /// The request as it was sent, with its CRC. The reply to function 6 is the request word for word: there the echo
  /// must be known.
  RtuReply(std::vector<std::uint8_t> request, LocalEcho echo) : m_request(std::move(request)), m_echo(echo) {}

  State add(std::span<const std::uint8_t> bytes);
  State state() const { return m_state; }
  const std::string& detail() const { return m_detail; }
  /// The whole reply without its CRC; its unit and function are not judged here.
  std::span<const std::uint8_t> frame() const;
  /// Known as far as these bytes tell.
  LocalEcho echo() const { return m_echo; }
  bool had_zeros() const { return m_zeros; }

 private:
  State look();
  State spoilt(std::string detail);

  std::vector<std::uint8_t> m_request;
  LocalEcho m_echo;
  std::vector<std::uint8_t> m_bytes;
  std::size_t m_start = 0;  // of the reply within the bytes
  std::size_t m_size = 0;
  bool m_echo_dropped = false;
  bool m_zeros = false;
  State m_state = State::incomplete;
  std::string m_detail;
};

}  // namespace zerodrift::controller
