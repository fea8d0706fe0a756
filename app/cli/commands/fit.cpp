// fit: regression from temperatures (and speeds) to the errors of one or several runs.

#include "core/analysis/fit.h"

#include <fmt/format.h>

#include "app/cli/command.h"
#include "core/base/json.h"
#include "core/recording/csv.h"

namespace zerodrift::cli {
namespace fit_command {

struct Options {
  std::vector<std::string> recordings;
  std::string sensors = "auto";
  std::string errors;
  std::string method = "auto";
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
  text += band.guaranteed_coverage > 0.0
              ? fmt::format("Band: stated {:.0f} %, guaranteed {:.0f} % (worst of {} cycles).",
                            100.0 * band.stated_coverage, 100.0 * band.guaranteed_coverage, model.quality.cycles)
              : std::string(
                    "Band: no coverage is stated. One cycle says nothing about other speeds; the band is the scatter "
                    "about this run. A second stretch at another speed would make it a statement.");
  return text;
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
  std::vector<recording::Recording> recordings;
  for (const auto& file : options.recordings) {
    ZD_TRY(recording::Recording recording, recording::read_recording(file));
    recordings.push_back(std::move(recording));
  }
  ZD_TRY(const analysis::Model model, analysis::fit(recordings, how, context));
  CommandOutput output;
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
  app.add_option("--recording", options->recordings, "Recording (CSV); may be given several times")->required();
  app.add_option("--sensors", options->sensors, "Channels to use, for example T1_C,T5_C, or auto")
      ->capture_default_str();
  app.add_option("--errors", options->errors, "Errors to fit, for example dX_um,dZ_um (default: all)");
  app.add_option("--method", options->method, "auto, mlr, ridge, pcr, lasso, robust, dynamic, arx, greybox or physics")
      ->check(CLI::IsMember({"auto", "mlr", "ridge", "pcr", "lasso", "robust", "dynamic", "arx", "greybox", "physics"}))
      ->capture_default_str();
  app.add_option("--max-sensors", options->max_sensors, "With --sensors auto: use at most so many (0: no limit)")
      ->check(CLI::Range(0, 1000))
      ->capture_default_str();
  app.add_option("--coverage", options->coverage_percent, "Coverage of the prediction band in percent")
      ->capture_default_str();
  app.add_option("--out", options->out, "model.json to write")->required();
}

}  // namespace zerodrift::cli
