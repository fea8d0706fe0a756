#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/acquisition/run.h"
#include "core/base/json.h"

namespace zerodrift::acquisition {
namespace {

constexpr double least_path_share = 0.5;  // of the measuring period: else the axes would not warm as planned
constexpr double first_part = 0.08;       // of the plan: what was measured in it tells what the whole will give
constexpr int most_attempts = 3;          // of one measurement of a machine that does not stay

}  // namespace

Status Run::measure() {
  publish(RunPhase::measuring);
  const std::size_t index = m_start.plan.index_at(plan_time_s(time_now_s()));
  const PlanStep& step = m_start.plan.steps[index];
  if (!m_paused_since_s) {
    ZD_CHECK(command(step.spindle_rpm, step.coolant_on, false));
  }
  const double due_s = m_next_measure_s;
  ZD_TRY(const Stand stand, come_to_measuring_position());
  ZD_CHECK(measure_here(stand));
  m_next_measure_s = next_measure_s(step);
  if (!m_paused_since_s) note_pace(due_s);
  if (step.path_cycle && !m_paused_since_s) m_commanded_step.reset();  // the path goes on
  return {};
}

/// From the end of a measurement: one that takes longer than its period must leave the path time to run.
double Run::next_measure_s(const PlanStep& step) const {
  const double period_s = m_start.plan.measure_period_s;
  const double path_s = step.path_cycle ? least_path_share * period_s : 0.0;
  return next_multiple(plan_time_s(time_now_s()) + path_s, period_s);
}

void Run::note_pace(double due_s) {
  const double period_s = m_start.plan.measure_period_s;
  const auto periods = std::llround((m_next_measure_s - due_s) / period_s);
  if (periods < 2) return clear("pace");
  raise("pace", {ErrorCode::measuring_stretched,
                 {{"period_s", fmt::format("{:g}", period_s)},
                  {"every_s", fmt::format("{:g}", static_cast<double>(periods) * period_s)}}});
}

/// In the first tenth, of the whole plan or of what remained of it when the run was resumed, whether the run will end
/// with enough good measurements.
Status Run::expect_enough() {
  const double total_s = m_start.plan.duration_s();
  const double passed_s = plan_time_s(time_now_s()) - m_judged_from_s;
  const double remained_s = total_s - m_judged_from_s;
  if (m_enough_expected || remained_s <= 0.0 || passed_s < first_part * remained_s) return {};
  m_enough_expected = true;
  const double planned = total_s / m_start.plan.measure_period_s + 1.0;
  const double needed = std::min(static_cast<double>(m_options.least_measurements), 0.5 * planned);
  const int good = m_summary.measurements - m_summary.refused;
  const double expected = m_good_stored + good * std::max(1.0, remained_s / passed_s);
  if (expected >= needed) return {};
  const Error error{ErrorCode::too_few_measurements,
                    {{"expected", fmt::format("{:.0f}", expected)}, {"needed", fmt::format("{:.0f}", needed)}}};
  if (m_options.refuse_too_few) return fail(error);
  raise("few", error);
  return {};
}

Status Run::measure_here(Stand stand) {
  Taken taken;
  for (int attempt = 1;; ++attempt) {
    ZD_TRY(taken, take(stand));
    // A machine that somebody moved meanwhile comes anew.
    const bool again = taken.measured && taken.measured->moved && attempt < most_attempts;
    if (!again || m_host.steady() > stand.until) break;
    const Seconds until = stand.until;
    ZD_TRY(stand, come_to_measuring_position());
    stand.until = until;
  }
  Result<ErrorSample>& measured = taken.measured;
  std::optional<Error> refused;
  if (measured && !measured->moved) refused = refusal_of(taken.row, *measured);
  note_measurement(measured, refused);
  ZD_CHECK(keep(taken.row, measured ? &*measured : nullptr, true));
  // A run whose first measurement fails has nothing to stand on; later the source may come back.
  const bool first = m_summary.measurements == (measured ? 1 : 0);
  if (first && refused) return fail(*refused);
  if (m_failed_measurements >= (m_summary.measurements == 0 ? 1 : m_options.failed_measurements)) {
    return fail(measured.error());
  }
  return {};
}

Result<Run::Taken> Run::take(const Stand& stand) {
  ZD_TRY(const MachineSample before, read());
  const Seconds begin = m_host.steady();
  Taken taken{m_errors.measure(stand, m_context), {}};
  Result<ErrorSample>& measured = taken.measured;
  if (!measured && measured.error().code == ErrorCode::cancelled) return cancelled();
  ZD_TRY(const MachineSample after, read());
  const Seconds all = m_host.steady() - begin;
  // The row belongs to the moment of the pictures, not to that at which they were measured.
  double part = 0.5;
  if (measured && measured->seen && all.count() > 0) part = std::clamp((*measured->seen - begin) / all, 0.0, 1.0);
  const bool whole = after.machine_time_s >= before.machine_time_s;
  taken.row = whole ? between(before, after, part) : after;
  if (measured && !measured->moved && !stands_at(after, m_start.plan.measure_position_mm)) {
    *measured = not_measured({"the machine moved while it was measured"}, true);
  }
  return taken;
}

/// What heat cannot have made since the last good measurement is taken out, and named.
std::optional<Error> Run::refusal_of(const MachineSample& row, ErrorSample& measured) {
  const double time_s = row.machine_time_s - m_start.origin_s;
  add_latency(time_s, measured);
  const HeatJudgement judged = judge_by_heat(m_drift, time_s, row.applied_um, measured);
  if (judged.refused) return judged.refused;
  if (judged.slipped) {
    raise("leap", *judged.slipped);
  } else {
    clear("leap");
  }
  m_good_before = judged.slipped ? std::nullopt : m_good;
  m_good = Good{time_s, judged.by_heat_um};
  return std::nullopt;
}

/// When a picture was taken is known to the spread of its latency; meanwhile the error drifts.
void Run::add_latency(double time_s, ErrorSample& measured) const {
  double spread_s = 0.0;
  for (const Settled& one : measured.settled) spread_s = std::max(spread_s, one.spread_s);
  if (!m_good_before || !m_good || !(m_good->time_s > m_good_before->time_s) || time_s <= m_good->time_s) return;
  for (std::size_t i = 0; i < 3; ++i) {
    const double drift_um_per_s =
        std::abs(m_good->error_um[i] - m_good_before->error_um[i]) / (m_good->time_s - m_good_before->time_s);
    const double moment_um = drift_um_per_s * spread_s * m_options.time_factor / std::sqrt(3.0);
    if (std::isfinite(moment_um)) measured.sigma_um[i] = std::hypot(measured.sigma_um[i], moment_um);
  }
}

void Run::note_measurement(const Result<ErrorSample>& measured, const std::optional<Error>& refused) {
  if (!measured) {
    ++m_failed_measurements;
    raise("errors", measured.error());
    return;
  }
  m_failed_measurements = 0;
  ++m_summary.measurements;
  note_settled(*measured);
  if (measured->remark) {
    raise("target", *measured->remark);
  } else {
    clear("target");
  }
  if (refused) {
    ++m_summary.refused;
    return raise("errors", *refused);
  }
  if (measured->problems.empty()) {
    clear("errors");
    return;
  }
  std::string reasons;
  for (const std::string& reason : measured->problems) reasons += (reasons.empty() ? "" : "; ") + reason;
  ++m_summary.refused;
  raise("errors", {ErrorCode::target_refused, {{"reason", reasons}}});
}

/// How the pictures were waited for stands beside every measurement.
void Run::note_settled(const ErrorSample& measured) {
  if (measured.settled.empty()) return;
  nlohmann::json views = nlohmann::json::array();
  for (const Settled& one : measured.settled) {
    views.push_back({{"view", one.view},
                     {"latency_s", one.latency_s},
                     {"spread_s", one.spread_s},
                     {"standstill_s", one.standstill_s}});
    const std::string key = "latency " + one.view;
    if (!one.widened) {
      clear(key);
      continue;
    }
    const std::string seconds = fmt::format("{:.1f}", one.latency_s + one.spread_s);
    raise(key, {ErrorCode::camera_late, {{"view", one.view}, {"seconds", seconds}}});
  }
  event("measured", "", json_text(nlohmann::json{{"views", views}}));
}

}  // namespace zerodrift::acquisition
