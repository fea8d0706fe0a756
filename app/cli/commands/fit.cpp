// fit: regression from temperatures (and speeds) to the errors of one or several runs.

#include "core/analysis/fit.h"

#include <fmt/format.h>

#include "app/cli/recording_input.h"
#include "core/analysis/ageing.h"
#include "core/analysis/training.h"
#include "core/base/json.h"
#include "core/commissioning/job.h"
#include "core/flow/flow.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/sensors_step.h"
#include "core/physics/simulate.h"

namespace zerodrift::cli {
namespace fit_command {

struct Options {
  std::vector<std::string> recordings;
  std::string map;
  std::string job;
  std::string sensors = "auto";
  std::string errors;
  std::string method = "auto";
  std::string machine;
  std::string update;
  int max_sensors = 0;
  double coverage_percent = 90.0;
  std::string out;
};

std::string text_of(const analysis::Model& model) {
  std::string text = fmt::format("{}\n", model.reason);
  text += "sensors:";
  for (const auto& s : model.sensors) text += " " + s;
  text += fmt::format("\n{:<10} {:>9} {:>9} {:>9} {:>9} {:>9}\n", "error", "fit rms", "left out", "peak", "removed",
                      "band +-");
  for (const auto& e : model.errors) {
    text += fmt::format("{:<10} {:>6.2f} um {:>6.2f} um {:>6.2f} um {:>7.1f} % {:>6.2f} um\n", e.error, e.fit.rms_um,
                        e.held_out.rms_um, e.held_out.peak_um, e.held_out.removed_percent, e.band.half_width_um);
  }
  for (const auto& c : model.candidates) {
    text += fmt::format("{} {:<40} left out {:.2f} um rms, {:.2f} um peak{}\n", c.chosen ? "*" : " ", c.label,
                        c.held_out_rms_um, c.held_out_peak_um,
                        c.runs_on_controller ? "; runs on the controller" : "; needs the host compensator");
  }
  if (!model.is_static()) {
    text += fmt::format("As a controller table the same leaves {:.0f} % more.\n", model.table_lost_percent);
  }
  for (const auto& advice : model.quality.advice) text += advice + "\n";
  const auto& band = model.errors.front().band;
  if (band.guaranteed_coverage > 0.0) {
    text += fmt::format("Band: stated {:.0f} %, guaranteed {:.0f} % (worst of {} cycles).",
                        100.0 * band.stated_coverage, 100.0 * band.guaranteed_coverage, model.quality.cycles);
  } else if (band.by_prior()) {
    text += fmt::format(
        "Band: stated {:.0f} %, nothing guaranteed: one cycle says little about other speeds, so the band rests on how "
        "machines are built and grows with what this run left open. A second stretch at another speed would test it.",
        100.0 * band.stated_coverage);
  } else {
    text +=
        "Band: no coverage is stated. One cycle says nothing about other speeds; the band is the scatter about this "
        "run. A second stretch at another speed would make it a statement.";
  }
  return text;
}

/// Each run with the displacements that the machine description says; `machine` receives the description as read.
Result<std::vector<recording::Recording>> simulated(const Options& options,
                                                    const std::vector<recording::Recording>& recordings,
                                                    std::string& machine, std::vector<std::string>& warnings,
                                                    const TaskContext& context) {
  if (options.method != "physics") {
    return fail(ErrorCode::bad_argument,
                {{"what", "--machine"}, {"found", "--method " + options.method}, {"expected", "--method physics"}});
  }
  ZD_TRY(const physics::Machine description, physics::read_machine(options.machine, &warnings));
  machine = json_text(physics::to_json(description));
  std::vector<recording::Recording> out;
  for (const auto& recording : analysis::join_continuing(recordings)) {
    const recording::Recording run = sound(recording, physics::measured_boundaries(description), warnings);
    ZD_TRY(recording::Recording more, physics::with_simulation(description, run, context));
    out.push_back(std::move(more));
  }
  return out;
}

/// The old model corrected by each run in turn.
Result<analysis::Model> updated(const Options& options, const std::vector<recording::Recording>& recordings,
                                std::vector<std::string>& warnings) {
  ZD_TRY(analysis::Model model, analysis::read_model(options.update, &warnings));
  if (model.method == analysis::Method::physics) {
    return fail(ErrorCode::bad_argument, {{"what", "--update"},
                                          {"found", "a physics model"},
                                          {"expected", "a model of another method (fit --method auto)"}});
  }
  for (const auto& recording : recordings) {
    ZD_TRY(model, analysis::update(model, recording));
  }
  return model;
}

/// The step of the job: on the sensors chosen in it, or chosen now, or those given here.
Result<analysis::Model> fitted_in_job(const Options& options, const TaskContext& context) {
  if (!options.machine.empty() || !options.update.empty() || !options.errors.empty()) {
    return fail(ErrorCode::bad_argument, {{"what", "--job"},
                                          {"found", "--machine, --update or --errors beside it"},
                                          {"expected", "--recording with these"}});
  }
  ZD_TRY(auto job, commissioning::Job::open(options.job));
  ZD_TRY(const auto before, job.latest("sensors"));
  if (!before || options.sensors != "auto") {
    const auto choose = [&](commissioning::Job& in, const TaskContext& inner) {
      flow::SensorsOptions sensors;
      if (options.sensors != "auto") sensors.chosen = names_from(options.sensors);
      auto chosen = flow::choose_sensors(in, sensors, inner);
      if (!chosen && chosen.error().code == ErrorCode::bad_argument && options.sensors == "auto") {
        sensors.clusters = 0;  // fewer sensors than the usual number of clusters
        chosen = flow::choose_sensors(in, sensors, inner);
      }
      return chosen;
    };
    ZD_CHECK(flow::Flow().perform(job, "sensors", choose, context).map([](const auto&) {}));
  }
  const auto fit = [&](commissioning::Job& in, const TaskContext& inner) {
    return flow::fit_model(in, {options.method}, inner);
  };
  ZD_TRY(const auto kept, flow::Flow().perform(job, "fit", fit, context));
  return flow::model_of(kept);
}

Result<CommandOutput> run(const Options& options, const TaskContext& context) {
  analysis::FitOptions how;
  ZD_TRY(how.method, analysis::method_from(options.method));
  if (options.sensors != "auto") how.sensors = names_from(options.sensors);
  how.errors = names_from(options.errors);
  if (!(options.coverage_percent >= 50.0 && options.coverage_percent < 100.0)) {
    return fail(ErrorCode::bad_argument, {{"what", "--coverage"},
                                          {"found", fmt::format("{}", options.coverage_percent)},
                                          {"expected", "50 to below 100 (percent)"}});
  }
  how.max_sensors = options.max_sensors;
  how.coverage = 0.01 * options.coverage_percent;
  CommandOutput output;
  ZD_TRY(std::vector<recording::Recording> recordings,
         recordings_from(options.recordings, options.map, output.warnings));
  std::string machine;
  if (!options.machine.empty()) {
    ZD_TRY(recordings, simulated(options, recordings, machine, output.warnings, context));
  }
  analysis::Model model;
  if (!options.job.empty()) {
    ZD_TRY(model, fitted_in_job(options, context));
  } else if (options.update.empty()) {
    ZD_TRY(model, analysis::fit(recordings, how, context));
  } else {
    ZD_TRY(model, updated(options, recordings, output.warnings));
    machine = model.machine;
  }
  if (options.job.empty()) model.machine = std::move(machine);
  output.json = analysis::to_json(model);
  output.text = text_of(model);
  for (const auto& finding : model.findings) output.warnings.push_back(analysis::describe(finding));
  ZD_CHECK(write_json_file(options.out, output.json));
  return output;
}

}  // namespace fit_command

void add_fit(Cli& cli) {
  using namespace fit_command;
  auto options = std::make_shared<Options>();
  CLI::App& app = *cli.add("fit", "Fit the thermal-error model to one or several runs",
                           [options](const TaskContext& context) { return run(*options, context); });
  app.add_option("--recording", options->recordings, "Recording (CSV); may be given several times");
  app.add_option("--job", options->job, "Job whose run is taken instead; the model is kept in it");
  require_recording_or_job(app, options->recordings, options->job);
  add_map_option(app, options->map);
  app.add_option("--sensors", options->sensors, "Channels to use, for example T1_C,T5_C, or auto")
      ->check(names_with_commas())
      ->capture_default_str();
  app.add_option("--errors", options->errors, "Errors to fit, for example dX_um,dZ_um (default: all)")
      ->check(names_with_commas());
  app.add_option("--method", options->method, "auto, mlr, ridge, pcr, lasso, robust, dynamic, arx, greybox or physics")
      ->check(CLI::IsMember({"auto", "mlr", "ridge", "pcr", "lasso", "robust", "dynamic", "arx", "greybox", "physics"}))
      ->capture_default_str();
  app.add_option(
      "--machine", options->machine,
      "With --method physics: machine description (JSON) whose simulated displacements are predictors beside "
      "the temperatures");
  app.add_option("--update", options->update,
                 "Correct this model.json by a short new run instead of starting over: what the run does not excite "
                 "stays; --method and --sensors are those of the old model");
  app.add_option("--max-sensors", options->max_sensors, "With --sensors auto: use at most so many (0: no limit)")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--coverage", options->coverage_percent, "Coverage of the prediction band in percent")
      ->check(CLI::Range(50.0, 99.99))
      ->capture_default_str();
  app.add_option("--out", options->out, "model.json to write")->required();
}

}  // namespace zerodrift::cli
