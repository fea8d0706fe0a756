// predict: what a fitted model says about a recording, with its band and a warning where it was never trained.

#include "core/analysis/predict.h"

#include <fmt/format.h>

#include "app/cli/recording_input.h"
#include "core/analysis/ageing.h"
#include "core/physics/simulate.h"
#include "core/recording/csv.h"

namespace zerodrift::cli {
namespace predict_command {

struct Options {
  std::string model;
  std::string recording;
  std::string map;
  std::string zero = "auto";
  std::string out;
};

nlohmann::json json_of(const analysis::Prediction& prediction) {
  nlohmann::json errors = nlohmann::json::object();
  for (const auto& e : prediction.errors) {
    nlohmann::json& entry = errors[e.error] = nlohmann::json::object();
    if (e.residual.count == 0) continue;
    entry = {{"rms_um", e.residual.rms_um},
             {"peak_um", e.residual.peak_um},
             {"removed_percent", e.residual.removed_percent},
             {"coverage", e.coverage},
             {"count", e.residual.count}};
  }
  return {{"rows", prediction.time_s.size()},
          {"zero", prediction.zero == analysis::Zero::start ? "start" : "training"},
          {"continued", prediction.continued},
          {"extrapolation", {{"share", prediction.extrapolation_share}, {"channel", prediction.extrapolation_channel}}},
          {"errors", std::move(errors)},
          {"findings", analysis::to_json(prediction.findings)}};
}

std::string text_of(const analysis::Prediction& prediction) {
  std::string text =
      fmt::format("{} rows, {}", prediction.time_s.size(),
                  prediction.continued                       ? "going on from the end of the training"
                  : prediction.zero == analysis::Zero::start ? "a new run: errors count from its own start"
                                                             : "errors count from the start of the training");
  for (const auto& e : prediction.errors) {
    if (e.residual.count == 0) continue;
    text +=
        fmt::format("\n{:<10} rms {:.2f} um, peak {:.2f} um, {:.1f} % of the peak removed, {:.0f} % inside the band",
                    e.error, e.residual.rms_um, e.residual.peak_um, e.residual.removed_percent, 100.0 * e.coverage);
  }
  return text;
}

Result<CommandOutput> run(const Options& options) {
  CommandOutput output;
  ZD_TRY(const analysis::Model model, analysis::read_model(options.model, &output.warnings));
  ZD_TRY(recording::Recording recording, recording_from(options.recording, options.map, output.warnings));
  if (!model.machine.empty()) {
    ZD_TRY(const physics::Machine machine,
           physics::machine_from_json(nlohmann::json::parse(model.machine), options.model, &output.warnings));
    ZD_TRY(recording, physics::with_simulation(machine, recording));
  }
  const analysis::Zero zero = options.zero == "auto"    ? analysis::Zero::automatic
                              : options.zero == "start" ? analysis::Zero::start
                                                        : analysis::Zero::training;
  auto prediction = analysis::predict(model, recording, zero);
  if (!prediction) return fail(std::move(prediction).error().with("file", options.recording));
  ZD_CHECK(recording::write_recording(options.out, prediction->to_recording()));
  output.json = json_of(*prediction);
  output.text = text_of(*prediction);
  nlohmann::json drift = nlohmann::json::object();
  for (const auto& check : analysis::check_drift(*prediction, recording)) {
    if (check.checks == 0) continue;
    drift[check.error] = {{"alarm", check.alarm}, {"checks", check.checks}};
    if (!check.alarm) continue;
    drift[check.error]["at_s"] = check.at_s;
    output.warnings.push_back(fmt::format(
        "{} has drifted away from the model (from {:.0f} s on): measure again and correct it with fit --update",
        check.error, check.at_s));
  }
  output.json["drift"] = std::move(drift);
  for (const auto& finding : prediction->findings) output.warnings.push_back(analysis::describe(finding));
  return output;
}

}  // namespace predict_command

void add_predict(Cli& cli) {
  using namespace predict_command;
  auto options = std::make_shared<Options>();
  CLI::App& app = *cli.add("predict", "Predict the errors of a recording with a fitted model",
                           [options](const TaskContext&) { return run(*options); });
  app.add_option("--model", options->model, "model.json of fit")->required();
  app.add_option("--recording", options->recording, "Recording (CSV) with the model's channels")->required();
  add_map_option(app, options->map);
  app.add_option("--zero", options->zero,
                 "What errors count from: the training's start, this recording's own start, or auto (a recording that "
                 "goes on from the training counts from its start)")
      ->check(CLI::IsMember({"auto", "training", "start"}))
      ->capture_default_str();
  app.add_option("--out", options->out, "prediction.csv to write")->required();
}

}  // namespace zerodrift::cli
