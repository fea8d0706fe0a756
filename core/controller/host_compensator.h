#pragma once
// The host compensator (C1): once a second or faster it reads the temperatures, lets the model predict and writes the
// offset, interlocked with the switch. Both sides watch: the host beats a heartbeat, the controller ramps the offset to
// 0 when it stops; and when the controller's own heartbeat stands still, a reply or not, nothing more is written to it,
// as if it were gone. Whatever ends it - asked to, the time over, an error, an exception thrown by the model or the
// observer - the offset is run to 0 and read back, and the switch goes back to where it was found. Runs for days in
// constant memory.

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "core/acquisition/machine_io.h"
#include "core/base/clock.h"
#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/compensation/follower.h"
#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {

struct HostCompensatorOptions {
  double period_s = 1.0;             // host seconds
  std::optional<double> duration_s;  // host seconds; none: until stopped
  bool switch_on = false;            // turn the compensation on first; otherwise it must be on
  double give_up_s = 60.0;           // host seconds without the machine before it ends with the link's error
  double silence_s = 3.0;   // host seconds its heartbeat may stand still; a controller that never beats is not watched
  double foreign_um = 2.0;  // applied beside what is written, for foreign_s of the machine's time: something else moves
  double foreign_s = 60.0;
  compensation::FollowerOptions follower;
  compensation::Predictor predictor;  // a model that remembers; none: the table predicts
};

struct CompensatorTurn {
  double machine_time_s = 0.0;
  std::map<std::string, double> axes;  // "X" -> mm, "A" -> degrees
  bool moving = false;
  double late_s = 0.0;  // begun after its time in the schedule
  compensation::FollowerOutput output;
  std::array<double, 3> applied_um{};  // as the controller tells
  bool switch_on = true;               // off: nothing was written (R4)
  bool link_lost = false;              // no turn: the machine did not answer, or not as it should
  std::optional<Error> fault;          // why not
  bool foreign = false;                // the controller applies something else than what was written
};

/// How late turns began against their schedule, in bins of 1 ms up to a second: a figure for days in constant memory.
class Lateness {
 public:
  void add(double late_s);
  double largest_s() const { return m_largest_s; }
  /// The upper edge of the bin below which the share of turns lies.
  double quantile_s(double share) const;
  /// Turns later than this (whole milliseconds below a second).
  long above(double late_s) const;

 private:
  std::array<long, 1001> m_bins{};  // the last: a second and more
  long m_count = 0;
  double m_largest_s = 0.0;
};

struct CompensatorSummary {
  long turns = 0;
  long late_turns = 0;  // turns that began more than half a period late
  long lost_turns = 0;  // without the machine
  Lateness lateness;
  std::array<double, 3> largest_offset_um{};  // absolute
};

/// Runs until stopped, or for the duration; the offset is back at 0 then. data_does_not_fit when the controller's own
/// table already compensates, or when it applies something although nothing is written. Once it has begun, an error is
/// compensation_ended when the machine was left as it was found, else compensation_left, with what it holds.
Result<CompensatorSummary> run_host_compensator(ModbusMachine& machine, const compensation::Table& table,
                                                const HostCompensatorOptions& options, const TaskContext& context,
                                                const std::function<void(const CompensatorTurn&)>& observer = {});

}  // namespace zerodrift::controller
