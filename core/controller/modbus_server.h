#pragma once
// A Modbus TCP server (Modbus application protocol V1.1b3, messaging over TCP V1.0b): holding registers by function
// codes 3, 6 and 16, several clients, one thread a client. What the registers mean is the callbacks' business; they are
// called from the clients' threads, also at the same time, and must lock for themselves.
// Strict where the standard is: 126 registers in one read or 124 in one write are answered with exception 3.
// Each reply can be spoilt on purpose, so that hosts can be tried against a faulty device.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::controller {

/// Exception codes of the application protocol, clause 7.
enum class ModbusException : std::uint8_t {
  illegal_function = 1,
  illegal_address = 2,
  illegal_value = 3,
  device_failure = 4,
  acknowledge = 5,
  busy = 6,
  gateway_path_unavailable = 10,
  gateway_target_silent = 11,
};

/// What is done to one reply.
struct ReplyFault {
  enum class Kind {
    none,
    late,               // sent whole, after the delay
    busy,               // exception 6 instead; the request is not carried out
    refused,            // the exception chosen instead; the request is not carried out
    refused_after,      // the exception chosen instead; the request is carried out all the same
    wrong_unit,         // unit one too high
    wrong_transaction,  // transaction id one too high
    truncated,          // the last half never comes
    drop,               // the connection is closed instead of a reply
    bytewise,           // one byte a packet
  };
  Kind kind = Kind::none;
  std::chrono::milliseconds delay{0};                 // before the reply; for bytewise: between bytes
  ModbusException exception = ModbusException::busy;  // of refused and refused_after
};

using RegisterReply = tl::expected<std::vector<std::uint16_t>, ModbusException>;

struct ModbusServerOptions {
  std::string host = "127.0.0.1";
  int port = 0;  // 0: any free port
  int unit = 1;  // 0 and 255 are answered as well, as is usual over TCP
  std::function<RegisterReply(int address, int count)> read;
  std::function<std::optional<ModbusException>(int address, std::span<const std::uint16_t> values)> write;
  std::function<ReplyFault(bool is_write)> fault;  // may be empty
  std::set<int> without_functions = {};            // answered with exception 1
};

class ModbusServer {
 public:
  /// Listens and serves until destroyed; port_unavailable when it cannot.
  static Result<std::unique_ptr<ModbusServer>> start(ModbusServerOptions options);
  ~ModbusServer();
  ModbusServer(const ModbusServer&) = delete;
  ModbusServer& operator=(const ModbusServer&) = delete;

  int port() const;

 private:
  class Impl;
  explicit ModbusServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace zerodrift::controller
