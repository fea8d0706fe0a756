#pragma once
// Measures what the compensation leaves, on a thread of its own, whenever the machine stands at the measuring position:
// a camera needs longer than a turn of the compensator. A leap that heat cannot make is refused and named, as in a run.

#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "core/acquisition/drift_limit.h"
#include "core/acquisition/error_source.h"
#include "core/base/result.h"
#include "core/controller/host_compensator.h"

namespace zerodrift::flow {

struct LiveMeasuringOptions {
  std::map<std::string, double> position_mm;
  double there_mm = 0.01;  // from it, on each axis: near enough to measure
  double every_s = 2.0;    // host seconds between two measurements
  acquisition::DriftRule drift;
};

class LiveMeasuring {
 public:
  /// The source is used from the thread alone; an error instead of one is why nothing is ever measured.
  LiveMeasuring(Result<std::unique_ptr<acquisition::ErrorSource>> source, LiveMeasuringOptions options);

  struct Now {
    std::optional<acquisition::ErrorSample> left;  // measured since the last call
    std::string not_measured;                      // why nothing is measured now; "" when it is
  };
  /// Takes where the machine is now; gives what was measured since the last call.
  Now exchange(const controller::CompensatorTurn& turn);

 private:
  bool stands_there(const controller::CompensatorTurn& turn) const;
  Result<acquisition::ErrorSample> measure(const acquisition::Stand& stand, const TaskContext& context);
  void judge(double begun_s, const std::array<double, 3>& begun_applied_um, acquisition::ErrorSample& sample);
  void work(const std::stop_token& stop);

  LiveMeasuringOptions m_options;
  std::unique_ptr<acquisition::ErrorSource> m_source;
  acquisition::DriftLimit m_drift;
  std::mutex m_mutex;
  std::condition_variable_any m_arrived;
  bool m_there = false;
  acquisition::Stand m_stand;     // since it is there
  long m_moves = 0;               // turns that found it elsewhere
  double m_machine_time_s = 0.0;  // of the last turn
  std::array<double, 3> m_applied_um{};
  std::optional<acquisition::ErrorSample> m_sample;
  std::string m_why;
  std::jthread m_thread;  // last: ends before what it uses
};

}  // namespace zerodrift::flow
