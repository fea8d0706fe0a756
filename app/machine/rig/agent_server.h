#pragma once
// The MTConnect agent over HTTP on 127.0.0.1: /probe (and /), /current, /sample?from=&count=. It looks at the machine
// once a machine second, at most 50 times a second, and at each request.

#include <memory>

#include "app/machine/live_machine.h"

namespace zerodrift::machine {

class AgentServer {
 public:
  /// Serves on a free port until destroyed.
  static Result<std::unique_ptr<AgentServer>> start(LiveMachine& machine, double machine_second_s);
  ~AgentServer();
  AgentServer(const AgentServer&) = delete;
  AgentServer& operator=(const AgentServer&) = delete;

  int port() const;

 private:
  class Impl;
  explicit AgentServer(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace zerodrift::machine
