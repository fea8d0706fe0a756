#pragma once
// A Modbus TCP client of a few lines that shares nothing with the product: what the wire really carries.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace zerodrift::testing {

class RawModbus {
 public:
  explicit RawModbus(int port);
  ~RawModbus();
  RawModbus(const RawModbus&) = delete;
  RawModbus& operator=(const RawModbus&) = delete;

  struct Reply {
    bool whole = false;   // a whole frame came within the timeout
    bool closed = false;  // the peer closed the connection
    bool same_transaction = false;
    std::vector<std::uint8_t> pdu;  // function code and what follows
    int packets = 0;                // pieces it arrived in
    int milliseconds = 0;

    int exception() const { return whole && (pdu[0] & 0x80U) != 0 ? pdu[1] : 0; }
  };
  Reply request(const std::vector<std::uint8_t>& pdu, int timeout_ms = 3000, int unit = 1);

  /// Registers, or nothing when refused.
  std::vector<std::uint16_t> read(int address, int count);
  int read_exception(int address, int count);
  /// 0, or the exception code.
  int write(int address, const std::vector<std::uint16_t>& words);
  int write_one(int address, std::uint16_t word);

 private:
  int m_socket = -1;
  std::uint16_t m_transaction = 0;
};

}  // namespace zerodrift::testing
