#pragma once
// The knobs of a control without a link, for a stand-in who turns them: HTTP on 127.0.0.1, JSON bodies.
//   POST /spindle {"rpm"}   /coolant {"on"}   /cycle {"on"}   /move {"X", "Y", "Z"}   /compensation {"on"}
//        /offset {"X", "Y", "Z"}   /table (zerodrift-table/1)                        GET /state
// Each answers {"done": true} when it is so: the spindle at speed, the axes there, the table active. 400 with a
// sentence for a wrong body, 409 where the machine is in no state for it.

#include <memory>

#include "app/machine/live_machine.h"

namespace zerodrift::machine {

class OperatorEndpoint {
 public:
  /// Serves on a free port until destroyed. The control then watches over no host: its watchdog is off.
  static Result<std::unique_ptr<OperatorEndpoint>> start(LiveMachine& machine);
  ~OperatorEndpoint();
  OperatorEndpoint(const OperatorEndpoint&) = delete;
  OperatorEndpoint& operator=(const OperatorEndpoint&) = delete;

  int port() const;

 private:
  class Impl;
  explicit OperatorEndpoint(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace zerodrift::machine
