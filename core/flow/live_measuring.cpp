#include "core/flow/live_measuring.h"

#include <chrono>
#include <cmath>
#include <exception>
#include <utility>

namespace zerodrift::flow {
namespace {

const std::string elsewhere = "the machine is not at the measuring position";
const std::string no_answer = "the controller does not answer";

}  // namespace

LiveMeasuring::LiveMeasuring(Result<std::unique_ptr<acquisition::ErrorSource>> source, LiveMeasuringOptions options)
    : m_options(std::move(options)), m_drift(m_options.drift) {
  if (!source) {
    m_why = describe(source.error());
    return;
  }
  m_source = std::move(*source);
  m_why = elsewhere;
  m_thread = std::jthread([this](const std::stop_token& stop) { work(stop); });
}

LiveMeasuring::Now LiveMeasuring::exchange(const controller::CompensatorTurn& turn) {
  const std::scoped_lock lock(m_mutex);
  const bool was_there = m_there;
  m_there = stands_there(turn);
  if (!m_there) ++m_moves;
  if (m_there && !was_there) m_stand = acquisition::standing_now();
  if (!turn.link_lost) {
    m_machine_time_s = turn.machine_time_s;
    m_applied_um = turn.applied_um;
  }
  Now now;
  now.left = std::exchange(m_sample, std::nullopt);
  now.not_measured = turn.link_lost ? no_answer : m_thread.joinable() && !m_there ? elsewhere : m_why;
  if (m_there) m_arrived.notify_all();
  return now;
}

bool LiveMeasuring::stands_there(const controller::CompensatorTurn& turn) const {
  if (turn.link_lost || turn.moving) return false;
  for (const auto& [axis, wanted_mm] : m_options.position_mm) {
    const auto at = turn.axes.find(axis);
    if (at == turn.axes.end() || !(std::abs(at->second - wanted_mm) <= m_options.there_mm)) return false;
  }
  return true;
}

/// On this thread an exception would end the program, and the offset would stay in the machine.
Result<acquisition::ErrorSample> LiveMeasuring::measure(const acquisition::Stand& stand, const TaskContext& context) {
  try {
    return m_source->measure(stand, context);
  } catch (const std::exception& thrown) {
    return fail(ErrorCode::internal, {{"detail", thrown.what()}});
  }
}

/// With the mutex held. What was compensated meanwhile went on from turn to turn: its middle counts.
void LiveMeasuring::judge(double begun_s, const std::array<double, 3>& begun_applied_um,
                          acquisition::ErrorSample& sample) {
  std::array<double, 3> applied_um{};
  for (std::size_t i = 0; i < 3; ++i) applied_um[i] = 0.5 * (begun_applied_um[i] + m_applied_um[i]);
  m_why = sample.problems.empty() ? std::string() : sample.problems.front();
  const double time_s = 0.5 * (begun_s + m_machine_time_s);
  const acquisition::HeatJudgement judged = acquisition::judge_by_heat(m_drift, time_s, applied_um, sample);
  if (judged.refused) m_why = describe(*judged.refused);
  m_sample = std::move(sample);
}

void LiveMeasuring::work(const std::stop_token& stop) {
  const TaskContext context{stop, {}};
  std::unique_lock lock(m_mutex);
  while (m_arrived.wait(lock, stop, [this] { return m_there; }) && !stop.stop_requested()) {
    const long moves = m_moves;
    const acquisition::Stand stand = m_stand;
    const double begun_s = m_machine_time_s;
    const std::array<double, 3> begun_applied_um = m_applied_um;
    lock.unlock();
    auto sample = measure(stand, context);
    lock.lock();
    // A machine that moved meanwhile was not measured where it was thought to stand.
    if (sample && moves == m_moves) {
      judge(begun_s, begun_applied_um, *sample);
    } else if (!sample) {
      m_why = describe(sample.error());
    }
    const auto rest = std::chrono::duration<double>(m_options.every_s);
    m_arrived.wait_for(lock, stop, rest, [] { return false; });
  }
}

}  // namespace zerodrift::flow
