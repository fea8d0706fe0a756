#include "core/acquisition/run_log.h"

namespace zerodrift::acquisition {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

Status RunLog::append(double time_s, std::span<const double> values) {
  ZD_CHECK(m_sink.append(time_s, values));
  ++m_rows;
  if (!m_waiting) {
    m_waiting = true;
    m_waiting_since = WallClock::now();
  }
  return {};
}

void RunLog::event(RunEvent event) {
  m_events.push_back(std::move(event));
  commit();
}

void RunLog::commit_before_waiting(double wait_s) {
  if (m_failure || (m_waiting && seconds_since(m_waiting_since) + wait_s >= m_commit_period_s)) commit();
}

Status RunLog::write_all() {
  ZD_CHECK(m_sink.flush());
  while (!m_events.empty()) {
    ZD_CHECK(m_sink.event(m_events.front()));
    m_events.erase(m_events.begin());
  }
  return {};
}

void RunLog::commit() {
  const Status done = write_all();
  if (done) {
    m_waiting = false;
    m_committed_rows = m_rows;
    m_failure.reset();
    return;
  }
  if (!m_failure) m_failing_since = WallClock::now();
  m_failure = done.error();
}

double RunLog::failing_s() const {
  return m_failure ? seconds_since(m_failing_since) : 0.0;
}

Status RunLog::end(RunEnd end) {
  commit();
  if (m_failure) return fail(*m_failure);
  return m_sink.end(end);
}

}  // namespace zerodrift::acquisition
