#pragma once
// The machine at rest at the measuring position, as its controller says it, with the host's time of what it said. What
// a camera shows is older: whoever measures waits until its pictures can only show this stand.

#include <array>
#include <functional>
#include <map>
#include <string>

#include "core/acquisition/machine_io.h"
#include "core/base/clock.h"

namespace zerodrift::acquisition {

/// From the measuring position, on each axis: no farther off is a machine that stands there, mm.
inline constexpr double there_mm = 0.01;

struct Stand {
  Seconds left{0.0};                // host time at which the move was commanded: before, it was elsewhere
  Seconds since{0.0};               // host time of the controller's first word that it is at rest here
  Seconds until{0.0};               // host time until which a measurement may be tried again
  std::array<double, 3> came_mm{};  // how far it came, X Y Z; 0: it need not have moved
  std::function<Status()> check;    // asks the controller again: an error when the machine moves or is elsewhere

  Status still() const { return check ? check() : Status(); }
};

/// For a machine that nobody moves: it stands from now on.
Stand standing_now(Clock& host = host_clock());

/// Drives there and returns when the controller says that the machine is at rest there. Errors: those of the machine;
/// machine_not_ready when it does not come to rest. The machine must outlive the stand.
Result<Stand> come_to(MachineIo& machine, const std::map<std::string, double>& position_mm, Clock& host = host_clock());

/// The same for one who reads and moves the machine in ways of its own.
using Reader = std::function<Result<MachineSample>()>;
Result<Stand> come_to(const Reader& read, const std::function<Status()>& move,
                      const std::map<std::string, double>& position_mm, Clock& host);

/// machine_not_ready, with the axis, when the reading shows the machine moving or elsewhere. Axes that the controller
/// does not report are taken as commanded.
Status stands_at(const MachineSample& sample, const std::map<std::string, double>& position_mm);

}  // namespace zerodrift::acquisition
