#include "core/flow/steps/verify_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/error_json.h"
#include "core/base/time_text.h"
#include "core/compensation/residual.h"
#include "core/flow/machine_table.h"
#include "core/flow/steps/inputs.h"
#include "core/flow/steps/verify_compare.h"
#include "core/report/comparison.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

constexpr double axis_threshold_um = 1.0;  // once the table is written again: what is worth correcting in each axis
const std::string no_correction = "no_correction";
const std::string verification_name = "verification";  // of its series

ResidualSamples residuals_of(const recording::Recording& run, const compensation::Table& table) {
  ResidualSamples samples;
  const auto sensors = compensation::sensors_of(table);
  for (const auto& [axis, record] : table.axes) {
    const auto* error = run.find("d" + axis + "_um");
    if (error == nullptr) continue;
    for (std::size_t r = 0; r < run.rows(); ++r) {
      if (std::isnan(error->values[r])) continue;
      compensation::ResidualSample sample;
      sample.residual_um = error->values[r];
      for (const auto& sensor : sensors) {
        const auto* channel = run.find(sensor);
        if (channel != nullptr) sample.temperatures[sensor] = recording::value_at(run, *channel, run.time_s[r]);
      }
      samples[axis].push_back(std::move(sample));
    }
  }
  return samples;
}

/// kappa and the corrected table, when the residual calls for one; a correction that cannot be made is no failure of
/// the verification, its reason is kept.
void propose_correction(const recording::Recording& run, const compensation::Table& table, double threshold_um,
                        json& body) {
  compensation::ResidualOptions options;
  options.threshold_um = std::min(threshold_um, axis_threshold_um);
  body["threshold_um"] = threshold_um;
  body["kappa"] = json::object();
  body["correction"] = json::array();
  body["corrected_table"] = nullptr;
  const auto correction = compensation::correct_residual(table, residuals_of(run, table), options);
  if (!correction) {
    json problem = to_json(correction.error());
    problem["said"] = no_correction;
    body["problems"].push_back(problem);
    return;
  }
  bool any = false;
  bool needed = false;
  for (const auto& axis : correction->axes) {
    any = any || axis.kind != compensation::CorrectionKind::none;
    needed = needed || axis.largest_before_um > threshold_um;
    body["kappa"][axis.axis] = axis.kappa;
    body["correction"].push_back({{"axis", axis.axis},
                                  {"kappa", axis.kappa},
                                  {"offset_um", axis.offset_um},
                                  {"largest_before_um", axis.largest_before_um},
                                  {"largest_after_um", axis.largest_after_um},
                                  {"reason", axis.reason}});
  }
  if (any && needed) body["corrected_table"] = compensation::to_json(correction->table);
}

void add_figures(const recording::Recording& warmup, const recording::Recording& after, double limit_um, json& body) {
  bool passed = true;
  for (const auto& [direction, size] : error_sizes(after)) {
    body["peak_error_after_um"][direction] = size.peak_um;
    body["rms_error_after_um"][direction] = size.rms_um;
    passed = passed && size.peak_um <= limit_um;
  }
  const auto reference = reference_of(after, warmup);
  const auto compared = report::compare_runs(reference.without, after);
  body["reference"] = reference.same_run ? "same_run" : "warmup";
  body["compared_s"] = compared.span_s;
  for (const auto& axis : compared.axes) {
    body["peak_error_before_um"][axis.axis] = axis.before_um;
    body["rms_error_before_um"][axis.axis] = axis.before_rms_um;
    body["end_error_before_um"][axis.axis] = axis.end_before_um;
    body["end_error_after_um"][axis.axis] = axis.end_after_um;
    if (axis.before_um > 0) body["removed_percent"][axis.axis] = axis.removed_percent;
  }
  body["limit_um"] = limit_um;
  body["verdict"] = passed && body.contains("peak_error_after_um") ? "passed" : "failed";
}

}  // namespace

acquisition::Plan verification_plan(const acquisition::Plan& warmup) {
  acquisition::Plan plan = warmup;
  plan.name = "verification";
  std::reverse(plan.steps.begin(), plan.steps.end());
  for (auto& step : plan.steps) step.duration_s *= 0.75;
  return plan;
}

Result<std::optional<RecordedRun>> interrupted_verification(const commissioning::Job& job) {
  ZD_TRY(auto interrupted, interrupted_recording(job, verification_name));
  if (!interrupted) return std::nullopt;
  ZD_TRY(const auto upload, job.latest("upload"));
  if (!upload) return std::nullopt;
  ZD_TRY(const UtcTime written, utc_from_text(upload->created_utc));
  ZD_TRY(const auto series, job.series_info(interrupted->series));
  ZD_TRY(const UtcTime begun, utc_from_text(series.started_utc));
  if (begun < written) return std::nullopt;
  return interrupted;
}

Result<commissioning::NewArtefact> verify(commissioning::Job& job, Devices& devices, const VerifyOptions& options,
                                          const TaskContext& context) {
  ZD_TRY(const Input warmup, need(job, "verify", "warmup"));
  ZD_TRY(const Input calibration, need(job, "verify", "calibration"));
  ZD_TRY(const Input upload, need(job, "verify", "upload"));
  ZD_TRY(const auto table, compensation::table_from_json(upload.body.at("table"), "the uploaded table"));
  RunOptions run_options = options.run;
  if (run_options.plan.steps.empty()) {
    ZD_TRY(const auto plan, acquisition::plan_from_json(warmup.body.at("plan"), "the warm-up's plan"));
    run_options.plan = verification_plan(plan);
  }
  acquisition::RecorderOptions recorder_options;
  recorder_options.name = verification_name;
  ZD_TRY(const auto interrupted, interrupted_verification(job));
  run_options.anew = run_options.anew || !interrupted;
  recorder_options.with_compensation = true;
  recorder_options.guard = acquisition::compensation_must_be_on("verification");
  if (warmup.body.contains("zero_um") && warmup.body["zero_um"].is_array()) {
    recorder_options.zero_um = warmup.body["zero_um"].get<std::array<double, 3>>();
  }
  ZD_TRY(const auto identity, devices.machine->identify());
  ZD_CHECK(same_machine(job, "verify", identity.serial));
  ZD_TRY(const auto start, devices.machine->read());
  // A run over another table proves nothing of this one.
  ZD_CHECK(table_is_active(devices, upload.body));
  // The switch may have been turned a moment ago: what is still on its way would count as error.
  ZD_CHECK(devices.machine->wait_for_ramp(true, context.stop).map([](double) {}));
  ZD_TRY(const RecordedRun run, record_run(job, devices, run_options, recorder_options, context));
  if (run.summary.end == acquisition::RunEnd::aborted) return fail(ErrorCode::cancelled);
  // Whoever wrote another one meanwhile has changed what was measured.
  ZD_CHECK(table_is_active(devices, upload.body));
  ZD_TRY(const auto after, job.read_series(run.series));
  ZD_TRY(const auto before, run_of(job, warmup));
  json body = run.body();
  body["machine_time_s"] = {start.machine_time_s, start.machine_time_s + run.summary.duration_s};
  add_figures(before, after, options.limit_um, body);
  body["outside_range"] = furthest_outside(after, table);
  for (const std::string text : body["outside_range"]) {
    body["problems"].push_back(text +
                               ": in the verification, the machine went outside the range the model was made in");
  }
  body["version_before"] = version_before(job, upload.id, residuals_of(after, table), table);
  propose_correction(after, table, std::min(options.limit_um, options.threshold_um), body);
  return commissioning::NewArtefact::of("verification", body, {warmup.id, calibration.id, upload.id});
}

Result<commissioning::NewArtefact> judge_again(const commissioning::Job& job, double threshold_um) {
  ZD_TRY(const auto artefact, job.latest("verification"));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "verify"}, {"needs", "verification"}});
  ZD_TRY(json body, artefact->document());
  ZD_TRY(const auto run, run_of(job, {artefact->id, body}));
  ZD_TRY(const auto residuals, verification_residuals(job));
  auto& problems = body["problems"];
  if (problems.is_array()) {
    json kept = json::array();
    for (const auto& problem : problems) {
      const bool of_correction = problem.is_object() && problem.value("said", "") == no_correction;
      if (!of_correction) kept.push_back(problem);
    }
    problems = std::move(kept);
  }
  propose_correction(run, residuals.table, threshold_um, body);
  std::vector<commissioning::ArtefactId> inputs;
  for (const auto& input : artefact->inputs) inputs.push_back(input.id);
  return commissioning::NewArtefact::of("verification", body, std::move(inputs));
}

Result<VerificationResiduals> verification_residuals(const commissioning::Job& job) {
  ZD_TRY(const auto artefact, job.latest("verification"));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "verify"}, {"needs", "verification"}});
  ZD_TRY(const json body, artefact->document());
  ZD_TRY(const auto run, run_of(job, {artefact->id, body}));
  VerificationResiduals out;
  for (const auto& input : artefact->inputs) {
    if (input.kind != "upload") continue;
    ZD_TRY(const auto upload, job.artefact(input.id));
    ZD_TRY(const json uploaded, upload.document());
    ZD_TRY(out.table, compensation::table_from_json(uploaded.at("table"), "the uploaded table"));
  }
  out.samples = residuals_of(run, out.table);
  for (const auto& [axis, samples] : out.samples) {
    const auto* error = run.find("d" + axis + "_um");
    for (std::size_t r = 0; r < run.rows(); ++r) {
      if (!std::isnan(error->values[r])) out.time_s[axis].push_back(run.time_s[r]);
    }
  }
  return out;
}

Result<std::optional<compensation::Table>> corrected_table(const commissioning::Artefact& artefact) {
  ZD_TRY(const json body, artefact.document());
  const auto at = body.find("corrected_table");
  if (at == body.end() || at->is_null()) return std::nullopt;
  ZD_TRY(auto table, compensation::table_from_json(*at, "the corrected table"));
  return table;
}

}  // namespace zerodrift::flow
