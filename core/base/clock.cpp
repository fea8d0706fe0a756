#include "core/base/clock.h"

#include <algorithm>

namespace zerodrift {
namespace {

UtcTime utc_now() {
  return std::chrono::time_point_cast<std::chrono::milliseconds>(std::chrono::system_clock::now());
}

UtcTime shifted(UtcTime start, Seconds by) {
  return start + std::chrono::duration_cast<std::chrono::milliseconds>(by);
}

}  // namespace

SystemClock::SystemClock(double speedup) : SystemClock(speedup, std::chrono::steady_clock::now()) {}

SystemClock::SystemClock(double speedup, std::chrono::steady_clock::time_point start)
    : m_speedup(speedup), m_start(start), m_start_utc(utc_now()) {}

UtcTime SystemClock::utc() const {
  return m_speedup == 1.0 ? utc_now() : shifted(m_start_utc, steady());
}

Seconds SystemClock::steady() const {
  return Seconds(std::chrono::steady_clock::now() - m_start) * m_speedup;
}

bool SystemClock::wait_until(Seconds deadline, std::stop_token stop) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);  // cppcheck-suppress localMutex; only what the condition needs
  const auto until = m_start + std::chrono::duration_cast<std::chrono::steady_clock::duration>(deadline / m_speedup);
  wake.wait_until(lock, stop, until, [] { return false; });
  return !stop.stop_requested();
}

Clock& host_clock() {
  static HostClock clock;
  return clock;
}

UtcTime ManualClock::utc() const {
  return shifted(UtcTime{}, steady());
}

Seconds ManualClock::steady() const {
  const std::scoped_lock lock(m_mutex);
  return m_now;
}

bool ManualClock::wait_until(Seconds deadline, std::stop_token stop) {
  const std::scoped_lock lock(m_mutex);
  if (stop.stop_requested()) return false;
  m_now = std::max(m_now, deadline);
  return true;
}

void ManualClock::advance(Seconds duration) {
  const std::scoped_lock lock(m_mutex);
  m_now += duration;
}

}  // namespace zerodrift
