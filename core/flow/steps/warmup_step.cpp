#include "core/flow/steps/warmup_step.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "core/acquisition/job_sink.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

struct Occurrence {
  int count = 0;
  std::set<std::string> what;  // which sensor, which reason
};

/// Which one an event is about: the sensor, the reason, the camera.
std::string particulars_of(const commissioning::Event& event) {
  const json details = json::parse(event.details, nullptr, false);
  if (!details.is_object() || !details.contains("context") || !details["context"].is_object()) return {};
  for (const char* key : {"sensor", "reason", "view"}) {
    const auto at = details["context"].find(key);
    if (at != details["context"].end() && at->is_string()) return at->get<std::string>();
  }
  return {};
}

/// The problems of a run in short, as recorded in its events: "sensor stuck (T1_C), 2 times".
Result<std::vector<std::string>> problems_of(const commissioning::Job& job, commissioning::SeriesId series) {
  ZD_TRY(const auto events, job.events(series));
  std::map<std::string, Occurrence> found;
  for (const auto& event : events) {
    if (event.kind != "problem" && event.kind != "gap") continue;
    std::string name = event.kind == "gap" ? "gap" : event.text;
    std::replace(name.begin(), name.end(), '_', ' ');
    Occurrence& one = found[name];
    ++one.count;
    if (const auto what = particulars_of(event); !what.empty()) one.what.insert(what);
  }
  std::vector<std::string> problems;
  for (const auto& [name, one] : found) {
    std::string text = name;
    if (!one.what.empty()) text += fmt::format(" ({})", fmt::join(one.what, "; "));
    problems.push_back(text + (one.count == 1 ? ", once" : fmt::format(", {} times", one.count)));
  }
  return problems;
}

Result<acquisition::RunSummary> run_or_resume(commissioning::Job& job, acquisition::MachineIo& machine,
                                              acquisition::ErrorSource& source, Clock& clock, const RunOptions& options,
                                              const acquisition::RecorderOptions& recorder_options,
                                              const TaskContext& context, RecordedRun& out) {
  ZD_TRY(const auto interrupted, acquisition::interrupted_run(job, recorder_options.name));
  acquisition::JobSink sink = interrupted ? acquisition::JobSink(job, interrupted->series) : acquisition::JobSink(job);
  acquisition::Recorder recorder(machine, source, clock, sink, recorder_options);
  if (options.control) options.control(&recorder.control());
  auto summary = interrupted ? recorder.resume(interrupted->run, context) : recorder.run(options.plan, context);
  if (options.control) options.control(nullptr);
  out.plan = interrupted ? interrupted->run.start.plan : options.plan;
  out.series = sink.series();
  return summary;
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
                {"problems", problems}};
  if (zero_um) value["zero_um"] = *zero_um;
  return value;
}

Result<RecordedRun> record_run(commissioning::Job& job, Devices& devices, const RunOptions& options,
                               acquisition::RecorderOptions recorder_options, const TaskContext& context) {
  vision::CameraErrorSource* cameras = nullptr;
  ZD_TRY(const auto source, open_error_source(job, devices, &cameras));
  if (options.cameras) options.cameras(cameras);
  recorder_options.time_factor = devices.profile.time_factor;
  recorder_options.observer = [&](const acquisition::RunUpdate& update) {
    context.progress(update.fraction, std::string(acquisition::name_of(update.phase)),
                     update.seconds_left / devices.profile.time_factor);
    if (options.observer) options.observer(update);
  };
  SystemClock clock(devices.profile.time_factor);
  RecordedRun run;
  auto summary = run_or_resume(job, *devices.machine, *source, clock, options, recorder_options, context, run);
  if (options.cameras) options.cameras(nullptr);
  if (!summary) return fail(std::move(summary).error());
  run.summary = *summary;
  run.source = source->name();
  run.zero_um = source->zero_um();
  ZD_TRY(run.problems, problems_of(job, run.series));
  for (const auto& [name, count] : devices.machine->health().faults) {
    run.problems.push_back(fmt::format("link: {}, {} times, overcome", name, count));
  }
  return run;
}

Result<commissioning::NewArtefact> record_warmup(commissioning::Job& job, Devices& devices, const RunOptions& options,
                                                 const TaskContext& context) {
  ZD_TRY(const Input machine, need(job, "warm-up", "machine"));
  ZD_TRY(const Input calibration, need(job, "warm-up", "calibration"));
  acquisition::RecorderOptions recorder_options;
  recorder_options.name = "warm-up";
  // Errors from cameras count from the template, taken at rest (V1): what drifted since is thermal error, too.
  if (calibration.body.value("source", "") == "camera") recorder_options.zero_um = std::array<double, 3>{};
  ZD_TRY(const RecordedRun run, record_run(job, devices, options, recorder_options, context));
  if (run.summary.end == acquisition::RunEnd::aborted) return fail(ErrorCode::cancelled);
  json body = run.body();
  ZD_TRY(const auto recording, job.read_series(run.series));
  for (const auto& [direction, size] : error_sizes(recording)) body["peak_um"][direction] = size.peak_um;
  return commissioning::NewArtefact::of("warmup", body, {machine.id, calibration.id});
}

}  // namespace zerodrift::flow
