#pragma once
// The recorder's way to the sink: rows and events wait here until they are committed, at the latest a commit period
// after they came. A full disk is a problem and not the end: what could not be committed is kept and tried again.

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "core/acquisition/run_sink.h"

namespace zerodrift::acquisition {

class RunLog {
 public:
  RunLog(RunSink& sink, double commit_period_s) : m_sink(sink), m_commit_period_s(commit_period_s) {}

  Status begin(const RunStart& start) { return m_sink.begin(start); }
  Status append(double time_s, std::span<const double> values);
  /// Rows that an earlier run of the program has stored.
  void go_on_from(std::int64_t rows) { m_rows = m_committed_rows = rows; }
  /// Committed at once, together with the rows before it, if the sink can.
  void event(RunEvent event);
  /// Commits if anything would otherwise wait for longer than the period when the caller now waits `wait_s` (wall).
  void commit_before_waiting(double wait_s);
  void commit();
  Status end(RunEnd end);

  std::int64_t rows() const { return m_rows; }
  std::int64_t committed_rows() const { return m_committed_rows; }
  /// The sink's last refusal, if it still refuses; and for how long it has (wall).
  const std::optional<Error>& failure() const { return m_failure; }
  double failing_s() const;

 private:
  using WallClock = std::chrono::steady_clock;
  Status write_all();

  RunSink& m_sink;
  double m_commit_period_s;
  std::vector<RunEvent> m_events;
  bool m_waiting = false;
  WallClock::time_point m_waiting_since{};
  std::int64_t m_rows = 0;
  std::int64_t m_committed_rows = 0;
  std::optional<Error> m_failure;
  WallClock::time_point m_failing_since{};
};

}  // namespace zerodrift::acquisition
