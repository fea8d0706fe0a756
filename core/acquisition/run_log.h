#pragma once
// The recorder's way to the sink: rows and events wait here until they are committed, at the latest a commit period
// after they came. The sink works in a thread of its own: a disk takes its time where the next sample does not wait. A
// full disk is a problem and not the end: what could not be committed is kept and tried again.

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "core/acquisition/run_sink.h"

namespace zerodrift::acquisition {

class RunLog {
 public:
  RunLog(RunSink& sink, double commit_period_s);
  /// Commits what is left, if the sink can.
  ~RunLog();

  Status begin(const RunStart& start) { return m_sink.begin(start); }
  /// An error is that of an earlier row, which the sink refused for good.
  Status append(double time_s, std::span<const double> values);
  /// Rows that an earlier run of the program has stored.
  void go_on_from(std::int64_t rows);
  /// Committed next, after the rows before it, if the sink can.
  void event(RunEvent event);
  /// Commits if anything would otherwise wait for longer than the period when the caller now waits `wait_s` (wall).
  /// Gives the sink a moment, so that the caller knows how it went; never longer than `wait_s`.
  void commit_before_waiting(double wait_s);
  /// Returns when all is committed, or refused.
  void commit();
  Status end(RunEnd end);

  std::int64_t rows() const;
  std::int64_t committed_rows() const;
  /// The sink's last refusal, if it still refuses; and for how long it has (wall).
  std::optional<Error> failure() const;
  double failing_s() const;

 private:
  using WallClock = std::chrono::steady_clock;
  struct Row {
    double time_s;
    std::vector<double> values;
  };
  struct Batch {
    std::vector<Row> rows;
    std::vector<RunEvent> events;
  };

  void work(const std::stop_token& stop);  // the sink's thread
  Status write(Batch& batch);
  void finish(const Status& done, const std::exception_ptr& thrown);
  std::int64_t ask();
  bool asked() const { return m_asked > m_answered; }

  RunSink& m_sink;
  const std::chrono::duration<double> m_commit_period;

  mutable std::mutex m_mutex;  // of what follows; not held while the sink works
  std::condition_variable_any m_wake;
  std::condition_variable_any m_done;
  Batch m_waiting;
  std::optional<WallClock::time_point> m_waiting_since;  // of the oldest that is not committed
  std::int64_t m_asked = 0;                              // commits asked for, and those that are over
  std::int64_t m_answered = 0;
  std::int64_t m_rows = 0;
  std::int64_t m_committed_rows = 0;
  std::optional<Error> m_failure;
  WallClock::time_point m_failing_since{};
  std::optional<Error> m_refused;  // a row; nothing mends that
  std::exception_ptr m_thrown;

  std::jthread m_thread;  // the last member: begins when the others are there and ends before they go
};

}  // namespace zerodrift::acquisition
