#include "core/acquisition/run_log.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace zerodrift::acquisition {
namespace {

// A disk that hangs must not take all memory: behind so many rows a row waits for it. 200 channels at 10 Hz fill that
// in a quarter of an hour, with 16 MB.
constexpr std::size_t most_rows_waiting = 10000;
constexpr double longest_moment_s = 0.1;

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

RunLog::RunLog(RunSink& sink, double commit_period_s)
    : m_sink(sink), m_commit_period(commit_period_s), m_thread([this](const std::stop_token& stop) { work(stop); }) {}

RunLog::~RunLog() {
  const std::scoped_lock lock(m_mutex);
  if (m_waiting_since) ask();
  m_thread.request_stop();
}

Status RunLog::append(double time_s, std::span<const double> values) {
  std::unique_lock lock(m_mutex);
  if (m_waiting.rows.size() >= most_rows_waiting) {
    const std::int64_t mine = ask();
    m_done.wait(lock, [&] { return m_answered >= mine; });
  }
  if (m_thrown) std::rethrow_exception(m_thrown);
  if (m_refused) return fail(*m_refused);
  m_waiting.rows.push_back({time_s, {values.begin(), values.end()}});
  ++m_rows;
  if (m_waiting_since) return {};
  m_waiting_since = WallClock::now();
  m_wake.notify_one();  // the period begins
  return {};
}

void RunLog::go_on_from(std::int64_t rows) {
  const std::scoped_lock lock(m_mutex);
  m_rows = m_committed_rows = rows;
}

void RunLog::event(RunEvent event) {
  const std::scoped_lock lock(m_mutex);
  m_waiting.events.push_back(std::move(event));
  if (!m_waiting_since) m_waiting_since = WallClock::now();
  ask();
}

/// With the lock held. The answer to this one is there when as many are answered.
std::int64_t RunLog::ask() {
  m_wake.notify_one();
  return ++m_asked;
}

void RunLog::commit_before_waiting(double wait_s) {
  std::unique_lock lock(m_mutex);
  const bool due = m_waiting_since && seconds_since(*m_waiting_since) + wait_s >= m_commit_period.count();
  if (!m_failure && !due) return;
  const std::int64_t mine = ask();
  const std::chrono::duration<double> moment(std::clamp(wait_s, 0.0, longest_moment_s));
  m_done.wait_for(lock, moment, [&] { return m_answered >= mine; });
  if (m_thrown) std::rethrow_exception(m_thrown);
}

void RunLog::commit() {
  std::unique_lock lock(m_mutex);
  const std::int64_t mine = ask();
  m_done.wait(lock, [&] { return m_answered >= mine; });
  if (m_thrown) std::rethrow_exception(m_thrown);
}

Status RunLog::end(RunEnd end) {
  commit();
  if (const auto failed = failure()) return fail(*failed);
  return m_sink.end(end);
}

void RunLog::work(const std::stop_token& stop) {
  std::unique_lock lock(m_mutex);
  Batch batch;  // what was not committed stays in it
  for (;;) {
    if (!m_waiting_since) {
      m_wake.wait(lock, stop, [&] { return asked() || m_waiting_since.has_value(); });
    } else {
      m_wake.wait_until(lock, stop, *m_waiting_since + m_commit_period, [&] { return asked(); });
    }
    if (stop.stop_requested() && !asked()) return;
    const bool due = m_waiting_since && WallClock::now() >= *m_waiting_since + m_commit_period;
    if (!asked() && !due) continue;
    std::move(m_waiting.rows.begin(), m_waiting.rows.end(), std::back_inserter(batch.rows));
    std::move(m_waiting.events.begin(), m_waiting.events.end(), std::back_inserter(batch.events));
    m_waiting = {};
    m_waiting_since.reset();
    const std::int64_t answered = m_asked;
    const std::int64_t rows = m_rows;
    lock.unlock();
    Status done;
    std::exception_ptr thrown;
    try {
      done = write(batch);
    } catch (...) {  // goes on in the recorder's thread
      thrown = std::current_exception();
    }
    lock.lock();
    m_answered = answered;
    if (done && !thrown && !m_refused) m_committed_rows = rows;
    finish(done, thrown);
  }
}

/// With the lock held.
void RunLog::finish(const Status& done, const std::exception_ptr& thrown) {
  if (thrown) m_thrown = thrown;
  if (!done && !m_failure) m_failing_since = WallClock::now();
  if (done) {
    m_failure.reset();
  } else {
    m_failure = done.error();
    m_waiting_since = WallClock::now();  // tried again a period later
  }
  m_done.notify_all();
}

/// What is done leaves the batch.
Status RunLog::write(Batch& batch) {
  for (const Row& row : batch.rows) {
    const Status kept = m_sink.append(row.time_s, row.values);
    if (kept) continue;
    const std::scoped_lock lock(m_mutex);
    m_refused = kept.error();
  }
  batch.rows.clear();
  ZD_CHECK(m_sink.flush());
  while (!batch.events.empty()) {
    ZD_CHECK(m_sink.event(batch.events.front()));
    batch.events.erase(batch.events.begin());
  }
  return {};
}

std::int64_t RunLog::rows() const {
  const std::scoped_lock lock(m_mutex);
  return m_rows;
}

std::int64_t RunLog::committed_rows() const {
  const std::scoped_lock lock(m_mutex);
  return m_committed_rows;
}

std::optional<Error> RunLog::failure() const {
  const std::scoped_lock lock(m_mutex);
  return m_failure;
}

double RunLog::failing_s() const {
  const std::scoped_lock lock(m_mutex);
  return m_failure ? seconds_since(m_failing_since) : 0.0;
}

}  // namespace zerodrift::acquisition
