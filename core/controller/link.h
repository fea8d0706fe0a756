#pragma once
// One Modbus connection, TCP or RTU. Requests are framed and replies checked here - transaction, protocol, length,
// unit, function, byte count - because libmodbus takes some wrong replies for good; it serves for connecting, the
// serial line and sending. Every call is bounded in time. After any error but a Modbus exception the connection is
// closed and opened anew with a growing pause, and a serial line is left in peace for a timeout, so that a late reply
// can never be taken for the answer to a later question. Reads, and writes that may be repeated, are tried again a few
// times while the fault may pass (acquisition/machine_fault.h); each fault is counted under its name. What a device or
// an adapter does beside the standard and is overcome - no function 6, local echo, zero bytes - is in remarks.
// One thread at a time.

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/controller/profile.h"
#include "core/controller/register_map.h"

namespace zerodrift::controller {

class SerialLine;

enum class Retry {
  yes,
  no,  // for a write that must not be sent twice without asking (a commit)
};

struct LinkHealth {
  long requests = 0;
  long retries = 0;
  long reconnects = 0;
  std::map<std::string, int> faults;  // error name -> how often it was met and overcome or given up
  std::vector<std::string> remarks;   // each once
};

class Link {
 public:
  /// Does not connect yet; the first request does.
  explicit Link(ControllerSettings settings);
  ~Link();
  Link(const Link&) = delete;
  Link& operator=(const Link&) = delete;

  /// `what` names the request in errors: "temperatures", "staging area". At most 125 registers.
  Result<std::vector<std::uint16_t>> read(RegisterSpace space, int address, int count, const std::string& what);
  /// Function 6 for one register, 16 for up to 123 and for a device without 6. machine_function_missing when the device
  /// has not what is needed.
  Status write(int address, std::span<const std::uint16_t> words, const std::string& what, Retry retry = Retry::yes);
  void close();

  const LinkHealth& health() const { return m_health; }
  const ControllerSettings& settings() const { return m_settings; }
  /// Tries of one request before it is given up (default 5).
  void set_attempts(int attempts) { m_attempts = attempts; }

 private:
  class Wire;
  using Pdu = std::vector<std::uint8_t>;  // function code and data

  Result<Pdu> exchange(const Pdu& request, const std::string& what, Retry retry);
  Status write_by(int function, int address, std::span<const std::uint16_t> words, const std::string& what,
                  Retry retry);
  Status find_local_echo(const Pdu& request, const std::string& what);
  void keep_remarks();
  Result<Pdu> exchange_once(const Pdu& request, const std::string& what, Retry retry);
  Result<Pdu> exchange_in_turn(const Pdu& request, const std::string& what, Retry retry);
  bool again(const Error& error, int attempt, Retry retry) const;

  ControllerSettings m_settings;
  std::unique_ptr<Wire> m_wire;
  LinkHealth m_health;
  int m_attempts = 5;
  bool m_was_connected = false;
  std::set<int> m_answered;            // functions that the device has carried out: it does not lack them
  bool m_without_6 = false;            // the device writes single registers by function 16
  std::shared_ptr<SerialLine> m_line;  // null over TCP
};

}  // namespace zerodrift::controller
