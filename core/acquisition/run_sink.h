#pragma once
// Where a recorder puts what it records. What flush() has acknowledged survives the process.

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/acquisition/plan.h"
#include "core/base/clock.h"
#include "core/base/result.h"

namespace zerodrift::acquisition {

/// What must be known to go on after a crash.
struct RunStart {
  std::string name;
  std::vector<std::string> channels;
  Plan plan;
  std::uint32_t machine_serial = 0;
  double origin_s = 0.0;  // machine clock at time_s = 0
  std::optional<std::array<double, 3>> zero_um;
};

/// A run that was broken off and can go on.
struct InterruptedRun {
  RunStart start;                        // origin_s as of the last restart of the machine's clock
  std::int64_t rows = 0;                 // stored
  double last_time_s = 0.0;              // of the last stored row
  UtcTime last_utc{};                    // of the last commit
  double paused_s = 0.0;                 // time that does not count for the plan
  std::optional<double> paused_since_s;  // it was pausing when it was broken off
  int good_measurements = 0;             // stored, in every direction that was ever measured
};

struct RunEvent {
  double time_s = 0.0;
  std::string kind;            // start, step, pause, resume, note, measured, problem, cleared, gap, clock, end
  std::string text;            // a note as typed, else an identifier
  std::string details = "{}";  // JSON text; an error's code and context for a problem; how long the
                               // pictures of a measurement were waited for
};

enum class RunEnd { finished, aborted };

class RunSink {
 public:
  virtual ~RunSink() = default;
  virtual Status begin(const RunStart& start) = 0;
  virtual Status append(double time_s, std::span<const double> values) = 0;
  virtual Status event(const RunEvent& event) = 0;
  virtual Status flush() = 0;
  virtual Status end(RunEnd end) = 0;
};

}  // namespace zerodrift::acquisition
