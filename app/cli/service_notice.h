#pragma once
// Tells systemd how a service is (sd_notify(3): one datagram to $NOTIFY_SOCKET): ready, alive, what it does, ending.
// Without that variable - started by hand - nothing is said.

#include <string>

namespace zerodrift::cli {

class ServiceNotice {
 public:
  ServiceNotice();
  ~ServiceNotice();
  ServiceNotice(const ServiceNotice&) = delete;
  ServiceNotice& operator=(const ServiceNotice&) = delete;

  /// One or more "NAME=value" lines: "READY=1", "WATCHDOG=1", "STATUS=following".
  void say(const std::string& lines) const;

 private:
  int m_socket = -1;
};

}  // namespace zerodrift::cli
