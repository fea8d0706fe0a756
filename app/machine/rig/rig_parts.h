#pragma once
// The parts of the rig beside control and cameras, each at an address of its own.

#include "app/machine/description.h"
#include "app/machine/live_machine.h"
#include "app/machine/rig/temperature_publisher.h"

namespace zerodrift::machine {

struct RigOptions {
  double machine_second_s = 1.0;  // wall time of a machine second
  std::optional<MqttBroker> broker = std::nullopt;
  bool manual_control = false;  // the control has no link: an operator turns its knobs
};

class RigParts {
 public:
  /// Serves until destroyed; the machine must live longer.
  static Result<std::unique_ptr<RigParts>> start(LiveMachine& machine, const RigOptions& options);
  ~RigParts();
  RigParts(const RigParts&) = delete;
  RigParts& operator=(const RigParts&) = delete;

  const RigEndpoints& endpoints() const;

 private:
  struct Parts;
  explicit RigParts(std::unique_ptr<Parts> parts);
  std::unique_ptr<Parts> m_parts;
};

}  // namespace zerodrift::machine
