#pragma once
// A real mosquitto broker on a free port of 127.0.0.1 as a child process, and who publishes there.

#include <sys/types.h>

#include <string>

#include "device_fixtures.h"

namespace zerodrift::controller {

class Broker {
 public:
  /// `lines` are added to its configuration. "FOLDER" in them is its folder.
  explicit Broker(const std::string& lines = "allow_anonymous true\n");
  ~Broker() { stop(); }
  Broker(const Broker&) = delete;
  Broker& operator=(const Broker&) = delete;

  static bool installed();
  /// Waits until it accepts connections.
  void start();
  void stop();
  int port() const { return m_port; }
  const TestFolder& folder() const { return m_folder; }
  /// For a device that reads it without a password.
  DeviceProfile profile() const;
  /// Returns when the broker has taken it.
  void publish(const std::string& topic, const std::string& payload, bool retained = false) const;

 private:
  TestFolder m_folder;
  int m_port;
  pid_t m_pid = -1;
};

/// The program of that name in PATH or beside the administrator's; empty when it is not installed.
std::string program(const std::string& name);
/// Runs it to its end; whether it succeeded.
bool run(const std::vector<std::string>& words);

}  // namespace zerodrift::controller
