#pragma once
// Starts a controller that is not ours as a child process for a test and stops it again: peer_server.py on pymodbus, or
// peer_server.js on npm modbus-serial or jsmodbus (found through NODE_PATH).

#include <sys/types.h>

#include <string>
#include <vector>

namespace zerodrift::controller {

class Peer {
 public:
  /// Starts and waits until it serves; running() is false where the stack is not installed.
  explicit Peer(const std::vector<std::string>& options = {}, const std::string& npm_package = {});
  ~Peer();
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  bool running() const { return m_running; }
  const std::string& profile_file() const { return m_profile; }
  int port() const { return m_port; }

 private:
  pid_t m_pid = -1;
  bool m_running = false;
  int m_port = 0;
  std::string m_profile;
};

/// Two pseudo-terminals joined like a serial cable (socat); running() is false where socat is not installed.
class SerialCable {
 public:
  SerialCable();
  ~SerialCable();
  SerialCable(const SerialCable&) = delete;
  SerialCable& operator=(const SerialCable&) = delete;

  bool running() const { return m_running; }
  const std::string& host_end() const { return m_host; }
  const std::string& device_end() const { return m_device; }

 private:
  pid_t m_pid = -1;
  bool m_running = false;
  std::string m_host;
  std::string m_device;
};

}  // namespace zerodrift::controller
