#include "core/flow/steps/warmup_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/acquisition/job_sink.h"
#include "core/acquisition/sample_grid.h"
#include "core/base/time_text.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

/// Which one an event is about: the sensor, the reason, the camera.
std::string particulars_of(const commissioning::Event& event) {
  const json details = json::parse(event.details, nullptr, false);
  if (!details.is_object() || !details.contains("context") || !details["context"].is_object()) return {};
  std::map<std::string, std::string> context;
  for (const auto& [key, value] : details["context"].items()) {
    if (value.is_string()) context[key] = value.get<std::string>();
  }
  return acquisition::Tally::particulars_of(context);
}

/// Counted from the events, so that a run taken up again is told whole.
Result<std::vector<acquisition::Happening>> happened_in(const commissioning::Job& job, commissioning::SeriesId series) {
  ZD_TRY(const auto events, job.events(series));
  acquisition::Tally tally;
  for (const auto& event : events) {
    if (event.kind == "gap") tally.add("gap", {});
    if (event.kind == "problem") tally.add(event.text, particulars_of(event));
  }
  return tally.all();
}

void add_link_faults(const Devices& devices, std::vector<acquisition::Happening>& happened) {
  if (devices.link == nullptr) return;
  for (const auto& [name, count] : devices.link->health().faults) happened.push_back({name, {}, count, true});
}

/// Up to where samples were missing before the row `to_s`: the run or the link was interrupted.
std::optional<double> gap_before(const std::vector<commissioning::Event>& events, double from_s, double to_s) {
  constexpr double close_s = 1e-3;
  for (const auto& event : events) {
    if (event.kind != "gap") continue;
    const json details = json::parse(event.details, nullptr, false);
    if (!details.is_object() || !details.contains("from_s") || !details.contains("to_s")) continue;
    const double end_s = details.value("to_s", 0.0);
    if (std::abs(details.value("from_s", 0.0) - from_s) < close_s && end_s < to_s + close_s) return end_s;
  }
  return std::nullopt;
}

/// What the rows themselves tell of a run: of one that nobody ended, or that was taken up again.
acquisition::RunSummary summary_of(const recording::Recording& run, const std::vector<commissioning::Event>& events,
                                   const acquisition::Plan& plan) {
  acquisition::RunSummary summary;
  summary.rows = static_cast<std::int64_t>(run.rows());
  summary.gaps = static_cast<int>(
      std::count_if(events.begin(), events.end(), [](const auto& event) { return event.kind == "gap"; }));
  if (run.rows() == 0) return summary;
  summary.duration_s = run.time_s.back();
  double measured_to_s = run.time_s.front();
  for (std::size_t r = 0; r < run.rows(); ++r) {
    int seen = 0;
    int directions = 0;
    for (const char* channel : {"dX_um", "dY_um", "dZ_um"}) {
      const auto* error = run.find(channel);
      if (error == nullptr) continue;
      ++directions;
      if (!std::isnan(error->values[r])) ++seen;
    }
    if (seen > 0) ++summary.measurements;
    if (seen > 0 && seen < directions) ++summary.refused;
    if (r == 0 || plan.sample_period_s <= 0.0) continue;
    const double before_s = run.time_s[r - 1];
    const auto lost = [&](double to_s) {
      summary.lost_samples +=
          acquisition::samples_between(std::max(before_s, measured_to_s), to_s, plan.sample_period_s);
    };
    if (const auto gap_s = gap_before(events, before_s, run.time_s[r])) {
      lost(*gap_s);
    } else if (seen == 0) {
      lost(run.time_s[r]);
    }
    // While the machine stands to be measured no sample is due; the row lies in the middle of that.
    if (seen > 0) measured_to_s = 2.0 * run.time_s[r] - before_s;
  }
  return summary;
}

/// The counts of a whole run that was taken up again: the recorder knows its own part alone.
Status count_whole(const commissioning::Job& job, commissioning::SeriesId series, const acquisition::Plan& plan,
                   acquisition::RunSummary& summary) {
  ZD_TRY(const auto recording, job.read_series(series));
  ZD_TRY(const auto events, job.events(series));
  const auto whole = summary_of(recording, events, plan);
  summary.measurements = whole.measurements;
  summary.refused = whole.refused;
  summary.lost_samples = whole.lost_samples;
  summary.gaps = whole.gaps;
  return {};
}

Result<acquisition::RunSummary> run_or_resume(commissioning::Job& job, acquisition::MachineIo& machine,
                                              acquisition::ErrorSource& source, Clock& clock, const RunOptions& options,
                                              const acquisition::RecorderOptions& recorder_options,
                                              const TaskContext& context, RecordedRun& out) {
  ZD_TRY(auto interrupted, acquisition::interrupted_run(job, recorder_options.name));
  if (interrupted && options.anew) {
    ZD_CHECK(job.finish_series(interrupted->series, commissioning::SeriesState::aborted));
    interrupted.reset();
  }
  acquisition::JobSink sink = interrupted ? acquisition::JobSink(job, interrupted->series) : acquisition::JobSink(job);
  acquisition::Recorder recorder(machine, source, clock, sink, recorder_options);
  if (options.control) options.control(&recorder.control());
  auto summary = interrupted ? recorder.resume(interrupted->run, context) : recorder.run(options.plan, context);
  if (options.control) options.control(nullptr);
  out.plan = interrupted ? interrupted->run.start.plan : options.plan;
  out.series = sink.series();
  if (summary && interrupted) ZD_CHECK(count_whole(job, out.series, out.plan, *summary));
  return summary;
}

Result<commissioning::NewArtefact> warmup_artefact(const commissioning::Job& job, const RecordedRun& run,
                                                   const Input& machine, const Input& calibration) {
  json body = run.body();
  ZD_TRY(const auto recording, job.read_series(run.series));
  for (const auto& [direction, size] : error_sizes(recording)) body["peak_um"][direction] = size.peak_um;
  return commissioning::NewArtefact::of("warmup", body, {machine.id, calibration.id});
}

}  // namespace

json RecordedRun::body() const {
  json value = {{"series", series},
                {"plan", acquisition::to_json(plan)},
                {"source", source},
                {"zero_um", nullptr},
                {"rows", summary.rows},
                {"lost_samples", summary.lost_samples},
                {"measurements", summary.measurements},
                {"refused", summary.refused},
                {"gaps", summary.gaps},
                {"duration_s", summary.duration_s},
                {"happened", acquisition::to_json(happened)},
                {"problems", json::array()}};
  for (const auto& one : happened) value["problems"].push_back(acquisition::text_of(one));
  if (zero_um) value["zero_um"] = *zero_um;
  // A row holds what was known at its moment: each device's last value, so old.
  for (const auto& device : devices) {
    value["devices"].push_back({{"id", device.id},
                                {"values", "held"},
                                {"answers", device.rounds},
                                {"faults", device.faults},
                                {"mean_age_s", device.mean_age_s},
                                {"largest_age_s", device.largest_age_s}});
    for (const auto& remark : device.remarks) value["problems"].push_back(device.id + ": " + remark);
  }
  return value;
}

namespace {

/// Errors from cameras count from the template, taken at rest (V1): what drifted since is thermal error, too. So the
/// run must be measured where the template was taken.
Status zero_of_template(const commissioning::Artefact& calibration, const controller::Profile& profile,
                        const acquisition::Plan& plan, acquisition::RecorderOptions& options) {
  for (const auto& [axis, position_mm] : profile.measure_position_mm) {
    const auto at = plan.measure_position_mm.find(axis);
    if (at == plan.measure_position_mm.end() || std::abs(at->second - position_mm) <= acquisition::there_mm) continue;
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the plan's measuring position"},
                 {"found", fmt::format("{} {:g} mm", axis, at->second)},
                 {"expected", fmt::format("{} {:g} mm, where the cameras were calibrated", axis, position_mm)}});
  }
  if (!options.zero_um) options.zero_um = std::array<double, 3>{};
  ZD_TRY(const UtcTime taken, utc_from_text(calibration.created_utc));
  const double age_s = Seconds(SystemClock().utc() - taken).count();
  options.zero_age_s = std::max(0.0, age_s) * profile.time_factor;
  return {};
}

}  // namespace

Result<RecordedRun> record_run(commissioning::Job& job, Devices& devices, const RunOptions& run_options,
                               acquisition::RecorderOptions recorder_options, const TaskContext& context) {
  RunOptions options = run_options;
  ZD_TRY(options.plan, acquisition::with_measuring_position(options.plan, devices.profile.measure_position_mm));
  ZD_TRY(const auto calibration, job.latest("calibration"));
  if (calibration && devices.profile.error_source == controller::ErrorSourceKind::camera) {
    ZD_CHECK(zero_of_template(*calibration, devices.profile, options.plan, recorder_options));
  }
  vision::CameraErrorSource* cameras = nullptr;
  ZD_TRY(const auto source, open_error_source(job, devices, &cameras));
  if (options.cameras) options.cameras(cameras);
  recorder_options.refuse_too_few = options.refuse_too_few;
  recorder_options.drift.um_per_min = devices.profile.max_drift_um_per_min;
  recorder_options.time_factor = devices.profile.time_factor;
  // A machine of iron waits for its next sample most of the time; an accelerated one would keep the processor.
  recorder_options.real_time = devices.profile.time_factor <= 1.0;
  recorder_options.observer = [&](const acquisition::RunUpdate& update) {
    context.progress(update.fraction, std::string(acquisition::name_of(update.phase)),
                     update.seconds_left / devices.profile.time_factor);
    if (!options.observer) return;
    acquisition::RunUpdate whole = update;
    add_link_faults(devices, whole.happened);
    options.observer(whole);
  };
  SystemClock clock(devices.profile.time_factor);
  RecordedRun run;
  auto summary = run_or_resume(job, *devices.machine, *source, clock, options, recorder_options, context, run);
  if (options.cameras) options.cameras(nullptr);
  if (!summary) return fail(std::move(summary).error());
  run.summary = *summary;
  run.source = source->name();
  run.zero_um = source->zero_um();
  ZD_TRY(run.happened, happened_in(job, run.series));
  add_link_faults(devices, run.happened);
  run.devices = devices.device_states();
  return run;
}

Result<commissioning::NewArtefact> record_warmup(commissioning::Job& job, Devices& devices, const RunOptions& options,
                                                 const TaskContext& context) {
  ZD_TRY(const Input machine, need(job, "warm-up", "machine"));
  ZD_TRY(const Input calibration, need(job, "warm-up", "calibration"));
  acquisition::RecorderOptions recorder_options;
  recorder_options.name = "warm-up";
  ZD_TRY(const RecordedRun run, record_run(job, devices, options, recorder_options, context));
  if (run.summary.end == acquisition::RunEnd::aborted) return fail(ErrorCode::cancelled);
  return warmup_artefact(job, run, machine, calibration);
}

Result<std::optional<RecordedRun>> interrupted_recording(const commissioning::Job& job, const std::string& name) {
  ZD_TRY(const auto interrupted, acquisition::interrupted_run(job, name));
  if (!interrupted) return std::nullopt;
  RecordedRun run;
  run.series = interrupted->series;
  run.plan = interrupted->run.start.plan;
  run.zero_um = interrupted->run.start.zero_um;
  ZD_TRY(const auto recording, job.read_series(run.series));
  ZD_TRY(const auto events, job.events(run.series));
  run.summary = summary_of(recording, events, run.plan);
  ZD_TRY(run.happened, happened_in(job, run.series));
  return run;
}

Result<std::optional<RecordedRun>> interrupted_warmup(const commissioning::Job& job) {
  return interrupted_recording(job, "warm-up");
}

Result<commissioning::NewArtefact> end_interrupted_warmup(commissioning::Job& job) {
  ZD_TRY(const Input machine, need(job, "warm-up", "machine"));
  ZD_TRY(const Input calibration, need(job, "warm-up", "calibration"));
  ZD_TRY(auto interrupted, interrupted_warmup(job));
  if (!interrupted) return fail(ErrorCode::step_blocked, {{"step", "warmup"}, {"needs", "an interrupted run"}});
  RecordedRun run = std::move(*interrupted);
  run.source = calibration.body.value("source", "");
  if (run.summary.rows == 0) return fail(ErrorCode::step_blocked, {{"step", "warmup"}, {"needs", "recorded samples"}});
  acquisition::JobSink sink(job, run.series);
  ZD_CHECK(sink.event({run.summary.duration_s, "end", "finished", R"({"machine": "away"})"}));
  ZD_CHECK(sink.end(acquisition::RunEnd::finished));
  ZD_CHECK(sink.flush());
  ZD_TRY(run.happened, happened_in(job, run.series));
  return warmup_artefact(job, run, machine, calibration);
}

}  // namespace zerodrift::flow
