#include "app/machine/rig/rtu_units.h"

#include "core/controller/rtu_reply.h"

namespace zerodrift::machine {
namespace {

using controller::ModbusException;

constexpr std::size_t crc_bytes = 2;
constexpr std::size_t read_request_bytes = 6;  // unit, function, address, count
constexpr int read_holding = 3;
constexpr int read_input = 4;
constexpr int largest_read = 125;
constexpr std::uint8_t exception_bit = 0x80;

std::uint8_t high_byte(int word) {
  return static_cast<std::uint8_t>(word >> 8);
}

std::uint8_t low_byte(int word) {
  return static_cast<std::uint8_t>(word & 0xFF);
}

controller::RegisterReply read_for(const RegisterReader& read, std::span<const std::uint8_t> request) {
  const int function = request[1];
  if (function != read_holding && function != read_input) return tl::unexpected(ModbusException::illegal_function);
  if (request.size() != read_request_bytes) return tl::unexpected(ModbusException::illegal_value);
  const int address = request[2] << 8 | request[3];
  const int count = request[4] << 8 | request[5];
  if (count < 1 || count > largest_read) return tl::unexpected(ModbusException::illegal_value);
  return read(address, count);
}

}  // namespace

std::vector<std::uint8_t> RtuUnits::answer(std::span<const std::uint8_t> frame) const {
  if (frame.size() < 2 + crc_bytes) return {};
  const auto request = frame.first(frame.size() - crc_bytes);
  const int stated = frame[frame.size() - 2] | frame[frame.size() - 1] << 8;
  if (controller::rtu_crc(request) != stated) return {};
  const auto unit = m_readers.find(request[0]);
  if (unit == m_readers.end()) return {};
  const auto values = read_for(unit->second, request);
  std::vector<std::uint8_t> reply{request[0], request[1]};
  if (values) {
    reply.push_back(low_byte(static_cast<int>(2 * values->size())));
    for (const std::uint16_t value : *values) {
      reply.push_back(high_byte(value));
      reply.push_back(low_byte(value));
    }
  } else {
    reply[1] |= exception_bit;
    reply.push_back(static_cast<std::uint8_t>(values.error()));
  }
  controller::append_rtu_crc(reply);
  return reply;
}

}  // namespace zerodrift::machine
