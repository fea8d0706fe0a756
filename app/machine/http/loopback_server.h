#pragma once
// An HTTP server on 127.0.0.1. Routes are added to http() before start(). Include this in .cpp files only: httplib.h is
// large.

#include <httplib.h>
#undef _res  // a macro of <resolv.h>, and a name in Eigen

#include <memory>
#include <thread>

#include "core/base/result.h"

namespace zerodrift::machine {

class LoopbackServer {
 public:
  LoopbackServer();
  ~LoopbackServer();
  LoopbackServer(const LoopbackServer&) = delete;
  LoopbackServer& operator=(const LoopbackServer&) = delete;

  httplib::Server& http() { return m_http; }
  /// Serves until stop(), which ends it for good; port 0 picks a free one. The port that is served, or
  /// port_unavailable.
  Result<int> start(int port);
  /// Requests that still run must end by themselves.
  void stop();

 private:
  httplib::Server m_http;
  std::thread m_listener;
};

}  // namespace zerodrift::machine
