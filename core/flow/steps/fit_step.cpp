#include "core/flow/steps/fit_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/analysis/ageing.h"
#include "core/analysis/fit.h"
#include "core/analysis/predict.h"
#include "core/base/json.h"
#include "core/compensation/model_table.h"
#include "core/controller/table_words.h"
#include "core/flow/steps/inputs.h"
#include "core/flow/steps/recordings_step.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

std::string summary_of(const analysis::Model& model) {
  double rms = 0.0;
  double peak = 0.0;
  for (const auto& error : model.errors) {
    rms = std::max(rms, error.held_out.rms_um);
    peak = std::max(peak, error.held_out.peak_um);
  }
  std::string text =
      fmt::format("Method {} on {} sensors: leaves at most {:.1f} um (rms {:.1f} um) on data it has not seen ({}).",
                  analysis::name_of(model.method), model.sensors.size(), peak, rms, model.held_out);
  if (!model.reason.empty()) text += " " + model.reason;
  return text;
}

/// What a model would leave that the controller cannot run; empty when that is no less.
std::string alternative_of(const analysis::Model& model) {
  const auto taken =
      std::find_if(model.candidates.begin(), model.candidates.end(), [](const auto& c) { return c.chosen; });
  for (const auto& other : model.candidates) {
    if (other.runs_on_controller || other.held_out_rms_um >= taken->held_out_rms_um) continue;
    return fmt::format(" A dynamic model, which needs the host compensator, would leave {:.1f} um rms.",
                       other.held_out_rms_um);
  }
  return {};
}

json number(double value) {
  return std::isfinite(value) ? json(value) : json(nullptr);
}

/// What a fit leaves in the job; `alternative` is added to its summary.
Result<commissioning::NewArtefact> artefact_of(const analysis::Model& model, const std::string& alternative,
                                               const controller::Profile& profile, bool has_machine, const json& warmup,
                                               std::vector<commissioning::ArtefactId> inputs) {
  const auto table = compensation::table_from_model(by_axes(model, warmup), controller::table_options(profile));
  // A job from files only may have errors of any name: without a controller nothing asks for a table.
  if (!table && has_machine) return fail(table.error());
  json figures = json::array();
  for (const auto& error : model.errors) {
    figures.push_back({{"channel", error.error},
                       {"rms_fit_um", number(error.fit.rms_um)},
                       {"rms_held_out_um", number(error.held_out.rms_um)},
                       {"peak_held_out_um", number(error.held_out.peak_um)},
                       {"band_um", number(error.band.half_width_um)}});
  }
  json rows = json::array();
  json offsets = json::object();
  for (const auto& [axis, record] : table ? table->axes : decltype(table->axes){}) {
    offsets[axis] = record.offset_um;
    for (const auto& term : record.terms) {
      rows.push_back(
          {{"axis", axis}, {"sensor", term.sensor}, {"um_per_K", term.um_per_K}, {"reference_C", term.reference_C}});
    }
  }
  const json document = {{"model", analysis::to_json(model)},
                         {"summary", summary_of(model) + alternative},
                         {"runs_on_controller", model.is_static()},
                         {"figures", figures},
                         {"table", rows},
                         {"offset_um", offsets}};
  return commissioning::NewArtefact::of("model", document, std::move(inputs));
}

/// Which runs were fitted, and what the model leaves on those of another day.
Status add_runs(const commissioning::Job& job, const analysis::Model& model,
                const std::vector<recording::Recording>& fitted, const recording::Recording& warmup,
                commissioning::NewArtefact& made) {
  ZD_TRY(const auto unseen, test_runs(job, warmup));
  if (fitted.size() < 2 && unseen.empty()) return {};
  ZD_TRY(json body, parse_json(made.body, "model"));
  body["fitted_too"] = json::array();
  for (std::size_t r = 1; r < fitted.size(); ++r) body["fitted_too"].push_back(fitted[r].name);
  body["tests"] = json::array();
  for (const auto& run : unseen) {
    ZD_TRY(const auto prediction, analysis::predict(model, run));
    json errors = json::array();
    for (const auto& error : prediction.errors) {
      if (error.residual.count == 0) continue;
      errors.push_back({{"channel", error.error},
                        {"rms_um", number(error.residual.rms_um)},
                        {"peak_um", number(error.residual.peak_um)},
                        {"removed_percent", number(error.residual.removed_percent)}});
    }
    body["tests"].push_back({{"recording", run.name}, {"errors", std::move(errors)}});
  }
  made.body = json_text(body);
  return {};
}

}  // namespace

analysis::Model by_axes(analysis::Model model, const json& warmup) {
  const auto axes = assigned_axes(warmup);
  for (auto& error : model.errors) error.error = error_by_axis(error.error, axes);
  for (auto& error : model.table) error.error = error_by_axis(error.error, axes);
  return model;
}

Result<compensation::Table> table_of_job(const commissioning::Job& job) {
  ZD_TRY(const auto artefact, job.latest("model"));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "upload"}, {"needs", "model"}});
  ZD_TRY(auto model, model_of(*artefact));
  ZD_TRY(const Input warmup, need(job, "upload", "warmup"));
  ZD_TRY(const auto machine, job.latest("machine"));
  controller::Profile profile;
  if (machine) {
    ZD_TRY(profile, profile_of(job, "upload"));
  } else {
    ZD_TRY(const auto header, job.header());
    profile.name = header.machine;
  }
  return compensation::table_from_model(by_axes(std::move(model), warmup.body), controller::table_options(profile));
}

Result<analysis::Model> model_of(const commissioning::Artefact& artefact) {
  ZD_TRY(const json body, artefact.document());
  return analysis::model_from_json(body.at("model"), "the job's model");
}

Result<commissioning::NewArtefact> fit_model(const commissioning::Job& job, const FitStepOptions& options,
                                             const TaskContext& context) {
  ZD_TRY(const Input warmup, need(job, "fit", "warmup"));
  ZD_TRY(const Input sensors, need(job, "fit", "sensors"));
  ZD_TRY(const auto run, run_of(job, warmup));
  ZD_TRY(const auto machine, job.latest("machine"));
  controller::Profile profile;  // of no machine when the run was imported: nothing is promised of a controller
  bool accepts_table = false;
  if (machine) {
    ZD_TRY(profile, profile_of(job, "fit"));
    ZD_TRY(const json body, machine->document());
    accepts_table = body.at("identity").value("accepts_table", false);
  }
  analysis::FitOptions fit_options;
  fit_options.sensors = sensors.body.at("chosen").get<std::vector<std::string>>();
  ZD_TRY(fit_options.method, analysis::method_from(options.method));
  // A controller that computes the table itself runs static models only: every figure is of what compensates, and what
  // a dynamic one would have left is said.
  fit_options.on_controller = accepts_table;
  ZD_TRY(const auto runs, training_runs(job, run));
  ZD_TRY(const auto model, analysis::fit(runs, fit_options, context));
  ZD_TRY(auto made,
         artefact_of(model, options.method == "auto" && accepts_table ? alternative_of(model) : std::string(), profile,
                     machine.has_value(), warmup.body, {warmup.id, sensors.id}));
  ZD_CHECK(add_runs(job, model, runs, run, made));
  return made;
}

Result<FitStepOptions> fit_asked_for(const commissioning::Job& job) {
  ZD_TRY(const auto latest, job.latest("model"));
  if (!latest) return FitStepOptions{};
  ZD_TRY(const auto model, model_of(*latest));
  return FitStepOptions{std::string(analysis::name_of(model.asked))};
}

Result<commissioning::NewArtefact> update_model(const commissioning::Job& job, const recording::Recording& run) {
  ZD_TRY(const Input warmup, need(job, "fit", "warmup"));
  ZD_TRY(const Input sensors, need(job, "fit", "sensors"));
  ZD_TRY(const auto machine, job.latest("machine"));
  controller::Profile profile;
  if (machine) {
    ZD_TRY(profile, profile_of(job, "fit"));
  }
  ZD_TRY(const auto latest, job.latest("model"));
  if (!latest) return fail(ErrorCode::step_blocked, {{"step", "fit"}, {"needs", "model"}});
  ZD_TRY(const auto old, model_of(*latest));
  ZD_TRY(const auto model, analysis::update(old, run));
  return artefact_of(model, {}, profile, machine.has_value(), warmup.body, {warmup.id, sensors.id});
}

}  // namespace zerodrift::flow
