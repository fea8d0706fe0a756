#pragma once
// Faults on purpose: "busy", "late:always", ... Without ":always" they come now and then, so that a run can go on.

#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "app/machine/camera/frame_source.h"
#include "app/machine/machine.h"
#include "core/controller/modbus_server.h"

namespace zerodrift::machine {

struct Fault {
  std::string name;
  bool always = false;
};

/// bad_argument lists the names.
Result<Fault> parse_fault(const std::string& text);

/// Decides the fate of each Modbus reply; called from the server's threads.
class ReplyFaults {
 public:
  explicit ReplyFaults(std::vector<Fault> faults) : m_faults(std::move(faults)) {}
  controller::ReplyFault next();

 private:
  std::vector<Fault> m_faults;
  std::atomic<unsigned> m_requests{0};
};

SensorFault sensor_fault(const std::vector<Fault>& faults);
/// The camera's fault with the window that is next (or now) at this machine time: five minutes of every thirty. Chips
/// fall while the machine works: their time counts from the spindle's first turn, and before it there are none.
CameraFault camera_fault(const std::vector<Fault>& faults, double machine_time_s, std::optional<double> first_turn_s);

}  // namespace zerodrift::machine
