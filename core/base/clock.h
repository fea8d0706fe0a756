#pragma once
// Time, injectable: the real clock, a clock that runs faster (for the virtual machine tool), a clock that a test sets.
// Two readings: UTC for stamps that people read, steady for durations (it never jumps when the wall clock is set).

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <stop_token>

namespace zerodrift {

using Seconds = std::chrono::duration<double>;
using UtcTime = std::chrono::sys_time<std::chrono::milliseconds>;

class Clock {
 public:
  virtual ~Clock() = default;
  virtual UtcTime utc() const = 0;
  /// Seconds since an arbitrary start, monotonic.
  virtual Seconds steady() const = 0;
  /// Waits until steady() reaches the deadline; false when stopped before.
  virtual bool wait_until(Seconds deadline, std::stop_token stop) = 0;

  bool wait_for(Seconds duration, std::stop_token stop) { return wait_until(steady() + duration, std::move(stop)); }
};

/// The machine's time: the host's steady clock times a factor (1 on a real machine; the virtual machine's speedup).
class SystemClock : public Clock {
 public:
  explicit SystemClock(double speedup = 1.0);
  UtcTime utc() const override;
  Seconds steady() const override;
  bool wait_until(Seconds deadline, std::stop_token stop) override;

 protected:
  SystemClock(double speedup, std::chrono::steady_clock::time_point start);

 private:
  double m_speedup;
  std::chrono::steady_clock::time_point m_start;
  UtcTime m_start_utc;
};

/// This computer's clock, by which pictures and replies are stamped: seconds of std::chrono::steady_clock itself.
class HostClock : public SystemClock {
 public:
  HostClock() : SystemClock(1.0, {}) {}
};
/// One for all; it has no state.
Clock& host_clock();

/// A clock that stands still until told; wait_until jumps there at once, so that tests never sleep.
class ManualClock : public Clock {
 public:
  UtcTime utc() const override;
  Seconds steady() const override;
  bool wait_until(Seconds deadline, std::stop_token stop) override;
  void advance(Seconds duration);

 private:
  mutable std::mutex m_mutex;
  Seconds m_now{0.0};
};

}  // namespace zerodrift
