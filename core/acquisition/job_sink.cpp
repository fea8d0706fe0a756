#include "core/acquisition/job_sink.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/base/time_text.h"
#include "core/recording/recording.h"

namespace zerodrift::acquisition {
namespace {

using commissioning::Event;
using commissioning::Job;
using commissioning::SeriesInfo;
using commissioning::SeriesState;
using nlohmann::json;

std::string details_of(const RunStart& start) {
  json details = {
      {"plan", to_json(start.plan)}, {"machine_serial", start.machine_serial}, {"origin_s", start.origin_s}};
  if (start.zero_um) details["zero_um"] = *start.zero_um;
  return json_text(details);
}

Result<RunStart> start_of(const SeriesInfo& series) {
  ZD_TRY(const json document, parse_json(series.details, series.name));
  RunStart start;
  start.name = series.name;
  start.channels = series.channels;
  ZD_TRY(start.plan, plan_of(series));
  ZD_CHECK(read_object(document, series.name, nullptr, [&](JsonObject& object) {
    start.machine_serial = static_cast<std::uint32_t>(object.number_or("machine_serial", 0.0, not_negative));
    start.origin_s = object.number("origin_s");
    if (object.has("zero_um")) {
      const auto zero = object.numbers("zero_um", 3);
      start.zero_um = {zero[0], zero[1], zero[2]};
    }
  }));
  return start;
}

// Pauses and restarts of the machine's clock, in the order in which they happened.
Status replay(const std::vector<Event>& events, InterruptedRun& run) {
  for (const Event& event : events) {
    if (event.kind == "pause") run.paused_since_s = event.time_s;
    if (event.kind != "resume" && event.kind != "clock") continue;
    ZD_TRY(const json details, parse_json(event.details, event.kind));
    ZD_CHECK(read_object(details, event.kind, nullptr, [&](JsonObject& object) {
      run.paused_s = object.number("paused_s");
      if (event.kind == "clock") run.start.origin_s = object.number("origin_s");
    }));
    if (event.kind == "resume") run.paused_since_s.reset();
  }
  return {};
}

int good_measurements(const recording::Recording& run) {
  std::vector<const recording::Channel*> seen;
  for (const char* name : {"dX_um", "dY_um", "dZ_um"}) {
    const auto* error = run.find(name);
    if (error != nullptr && recording::present_count(*error) > 0) seen.push_back(error);
  }
  int good = 0;
  for (std::size_t r = 0; r < run.rows() && !seen.empty(); ++r) {
    good += std::all_of(seen.begin(), seen.end(), [r](const auto* error) { return std::isfinite(error->values[r]); });
  }
  return good;
}

Result<InterruptedSeries> interrupted(const Job& job, const SeriesInfo& info) {
  InterruptedSeries found;
  found.series = info.id;
  found.run.rows = info.rows;
  ZD_TRY(found.run.start, start_of(info));
  ZD_TRY(found.run.last_utc, utc_from_text(info.last_utc));
  std::vector<Error> damaged;  // a gap for the reader, no reason not to go on
  ZD_TRY(const recording::Recording recording, job.read_series(info.id, &damaged));
  if (!recording.time_s.empty()) found.run.last_time_s = recording.time_s.back();
  found.run.good_measurements = good_measurements(recording);
  ZD_TRY(const auto events, job.events(info.id));
  ZD_CHECK(replay(events, found.run));
  return found;
}

}  // namespace

Status JobSink::begin(const RunStart& start) {
  ZD_TRY(m_series, m_job.start_series(start.name, start.channels, details_of(start)));
  return {};
}

Status JobSink::append(double time_s, std::span<const double> values) {
  return m_job.append(m_series, time_s, values);
}

Status JobSink::event(const RunEvent& event) {
  return m_job.add_event(m_series, {event.time_s, event.kind, event.text, event.details, {}});
}

Status JobSink::flush() {
  return m_job.flush();
}

Status JobSink::end(RunEnd end) {
  return m_job.finish_series(m_series, end == RunEnd::finished ? SeriesState::finished : SeriesState::aborted);
}

Result<std::optional<InterruptedSeries>> interrupted_run(const Job& job, const std::string& name) {
  ZD_TRY(const auto all, job.series());
  for (auto info = all.rbegin(); info != all.rend(); ++info) {
    if (info->name != name) continue;
    if (info->state != SeriesState::open) break;
    ZD_TRY(InterruptedSeries found, interrupted(job, *info));
    return std::optional(std::move(found));
  }
  return std::optional<InterruptedSeries>();
}

Result<std::optional<InterruptedSeries>> interrupted_run(const Job& job) {
  ZD_TRY(const auto all, job.series());
  if (all.empty() || all.back().state != SeriesState::open) return std::optional<InterruptedSeries>();
  ZD_TRY(InterruptedSeries found, interrupted(job, all.back()));
  return std::optional(std::move(found));
}

Result<Plan> plan_of(const SeriesInfo& series) {
  ZD_TRY(const json document, parse_json(series.details, series.name));
  const auto plan = document.find("plan");
  if (plan == document.end()) {
    return fail(ErrorCode::json_missing_key, {{"file", series.name}, {"key", "plan"}, {"expected", "a plan"}});
  }
  return plan_from_json(*plan, series.name);
}

}  // namespace zerodrift::acquisition
