// The model and its honest figures: on data it has not seen.

#include "core/analysis/model.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/analysis/predict.h"
#include "core/report/build.h"
#include "core/report/limits.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

/// "What it leaves" in one sentence, from the figures rather than from a stored text.
Text summary_of(const Source& source, const nlohmann::json& body) {
  const auto model = object_of(body, "model");
  double rms = 0.0;
  double peak = 0.0;
  for (const auto& figure : list_of(body, "figures")) {
    rms = std::fmax(rms, number_of(figure, "rms_held_out_um"));
    peak = std::fmax(peak, number_of(figure, "peak_held_out_um"));
  }
  std::string text = source.tell(
      "Method {} on {} sensors: on data it has not seen ({}) it leaves at most {} µm, {} µm rms in the worst "
      "direction.",
      source.say(text_of(model, "method")), list_of(model, "sensors").size(), source.say(text_of(model, "held_out")),
      shown(peak, 1), shown(rms, 1));
  if (const std::string reason = text_of(model, "reason"); !reason.empty()) {
    text += " " + source.tell("Why this method (rms here is the mean of the directions): {}.", source.in_words(reason));
  }
  const std::string stored = text_of(body, "summary");
  const auto alternative = stored.find("A dynamic model");
  if (alternative != std::string::npos) text += " " + source.in_words(stored.substr(alternative));
  return {text, false};
}

Table figures_of(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "model_figures";
  table.title = source.say("What the model leaves, µm");
  table.header = {source.say("direction"),         source.say("RMS, fitted part"),   source.say("RMS, unseen"),
                  source.say("largest, unseen"),   source.say("removed, unseen, %"), source.say("band ±"),
                  source.say("inside the band, %")};
  table.trace = source.at("model", "/figures");
  const auto errors = list_of(object_of(body, "model"), "errors");
  int number = 0;
  for (const auto& figure : list_of(body, "figures")) {
    const std::string channel = text_of(figure, "channel");
    const std::string pointer = fmt::format("/figures/{}/", number);
    const std::string inner = fmt::format("/model/errors/{}/", number);
    const auto error = static_cast<std::size_t>(number) < errors.size() ? errors[static_cast<std::size_t>(number)]
                                                                        : nlohmann::json::object();
    ++number;
    const auto band = object_of(error, "band");
    const bool stated = number_of(band, "stated_coverage") > 0.0;
    Cell peak = cell(number_of(figure, "peak_held_out_um"), 2, "held_out_peak_" + channel,
                     source.at("model", pointer + "peak_held_out_um"));
    peak.verdict = number_of(figure, "peak_held_out_um") > limits::attainable_peak_um ? Verdict::bad : Verdict::none;
    table.rows.push_back(
        {tag_of(channel, source.labels()),
         cell(number_of(figure, "rms_fit_um"), 2, "fit_rms_" + channel, source.at("model", pointer + "rms_fit_um")),
         cell(number_of(figure, "rms_held_out_um"), 2, "held_out_rms_" + channel,
              source.at("model", pointer + "rms_held_out_um")),
         std::move(peak),
         cell(number_of(object_of(error, "held_out"), "removed_percent"), 1, "held_out_removed_" + channel,
              source.at("model", inner + "held_out/removed_percent")),
         cell(stated ? number_of(band, "half_width_um") : std::nan(""), 2, "band_" + channel,
              source.at("model", inner + "band/half_width_um")),
         cell(stated ? 100.0 * number_of(band, "measured_coverage") : std::nan(""), 0, "coverage_" + channel,
              source.at("model", inner + "band/measured_coverage"))});
  }
  return table;
}

Curve curve_of(const std::string& name, const std::vector<double>& time_s, const std::vector<double>& values, Hue hue,
               Stroke stroke) {
  Curve curve{name, {}, {}, false, hue, stroke};
  for (std::size_t r = 0; r < time_s.size(); ++r) {
    curve.x.push_back((time_s[r] - time_s.front()) / 3600.0);
    curve.y.push_back(values[r]);
  }
  return curve;
}

/// Measured against predicted, with the band; on the run it was fitted on, which the title says.
void add_plots(const Source& source, const nlohmann::json& body, Section& section) {
  const auto* run = source.run_of("warmup");
  if (run == nullptr || !body.contains("model")) return;
  const auto model = analysis::model_from_json(body.at("model"), "model");
  if (!model) return;
  const auto prediction = analysis::predict(*model, *run);
  if (!prediction) return;
  for (const auto& error : prediction->errors) {
    Plot plot;
    plot.id = "predicted_" + error.error;
    plot.title = source.tell("Measured and predicted on the fitted run, {}", source.channel_in_words(error.error));
    plot.x_label = source.say("hours");
    plot.y_label = "µm";
    plot.width = Width::half;
    plot.curves = curves_of(*run, {error.error}, true, source.labels());
    for (auto& curve : plot.curves) curve.name = source.say("measured");
    plot.curves.push_back(curve_of(source.say("predicted"), prediction->time_s, error.value_um,
                                   hue_of(error.error, source.labels()), Stroke::solid));
    std::vector<double> low = error.value_um;
    std::vector<double> high = error.value_um;
    for (std::size_t r = 0; r < low.size() && r < error.half_width_um.size(); ++r) {
      low[r] -= error.half_width_um[r];
      high[r] += error.half_width_um[r];
    }
    plot.curves.push_back(curve_of(source.say("band"), prediction->time_s, low, Hue::muted, Stroke::thin));
    plot.curves.push_back(curve_of("", prediction->time_s, high, Hue::muted, Stroke::thin));
    plot.trace = source.trace("model", error.error);
    section.blocks.emplace_back(std::move(plot));
  }
}

Table candidates_of(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "methods";
  table.title = source.say("Methods tried, error on unseen data");
  table.header = {source.say("method"), source.say("RMS, µm"), source.say("largest, µm"),
                  source.say("runs on the controller"), source.say("taken")};
  table.trace = source.at("model", "/model/candidates");
  int number = 0;
  for (const auto& one : list_of(object_of(body, "model"), "candidates")) {
    const std::string pointer = fmt::format("/model/candidates/{}/", number++);
    table.rows.push_back({source.in_words(text_of(one, "label")),
                          cell(number_of(one, "held_out_rms_um"), 2, fmt::format("method_{}_rms_um", number),
                               source.at("model", pointer + "held_out_rms_um")),
                          cell(number_of(one, "held_out_peak_um"), 2, fmt::format("method_{}_peak_um", number),
                               source.at("model", pointer + "held_out_peak_um")),
                          source.say(one.value("runs_on_controller", false) ? "yes" : "no"),
                          one.value("chosen", false) ? source.say("yes") : ""});
  }
  return table;
}

/// Directions side by side: a row a sensor.
Table coefficients_of(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "coefficients";
  table.title = source.say(
      "Coefficients as fitted: error = offset + sum of coefficient × (T − reference); corrections "
      "stand with the table");
  table.header = {source.say("sensor"), "X, µm/K", "Y, µm/K", "Z, µm/K", source.say("reference, °C")};
  table.trace = source.at("model", "/table");
  std::map<std::string, std::size_t> row_of_sensor;
  int number = 0;
  for (const auto& term : list_of(body, "table")) {
    const std::string sensor = text_of(term, "sensor");
    const std::string pointer = fmt::format("/table/{}/um_per_K", number++);
    const auto [at, is_new] = row_of_sensor.try_emplace(sensor, table.rows.size());
    if (is_new) {
      table.rows.push_back({source.channel_in_words(sensor), "", "", "", shown(number_of(term, "reference_C"), 2)});
    }
    const std::size_t column = std::string("XYZ").find(text_of(term, "axis"));
    if (column > 2) continue;
    table.rows[at->second][column + 1] = cell(
        number_of(term, "um_per_K"), 3,
        "coefficient_" + text_of(term, "axis") + "_" + sensor.substr(0, sensor.find('_')), source.at("model", pointer));
  }
  if (table.rows.empty()) return table;
  std::vector<Cell> offsets = {source.say("offset, µm")};
  for (const char* axis : {"X", "Y", "Z"}) {
    offsets.push_back(cell(number_of(body, "offset_um", axis), 2, std::string("model_offset_") + axis + "_um",
                           source.at("model", std::string("/offset_um/") + axis)));
  }
  offsets.emplace_back("");
  table.rows.push_back(std::move(offsets));
  return table;
}

/// What the model leaves on runs of another day, of which it has seen nothing.
Table tests_of(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "model_tests";
  table.title = source.say("What the model leaves on recordings of another day, µm");
  table.header = {source.say("recording"), source.say("direction"), source.say("RMS"), source.say("largest"),
                  source.say("removed, %")};
  table.trace = source.at("model", "/tests");
  int run = 0;
  for (const auto& test : list_of(body, "tests")) {
    int number = 0;
    for (const auto& error : list_of(test, "errors")) {
      const std::string channel = text_of(error, "channel");
      const std::string pointer = fmt::format("/tests/{}/errors/{}/", run, number++);
      const auto figure = [&](const char* key, int digits) {
        return cell(number_of(error, key), digits, fmt::format("test_{}_{}_{}", run + 1, channel, key),
                    source.at("model", pointer + key));
      };
      table.rows.push_back({text_of(test, "recording"), tag_of(channel, source.labels()), figure("rms_um", 2),
                            figure("peak_um", 2), figure("removed_percent", 1)});
    }
    ++run;
  }
  return table;
}

}  // namespace

std::optional<Section> model_section(const Source& source) {
  const LoadedArtefact* model = source.find("model");
  if (model == nullptr) return std::nullopt;
  Section section{"model", source.say("Compensation model"), {}};
  section.blocks.emplace_back(summary_of(source, model->body));
  section.blocks.emplace_back(figures_of(source, model->body));
  if (auto table = tests_of(source, model->body); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  add_plots(source, model->body, section);
  if (auto table = candidates_of(source, model->body); !table.rows.empty()) {
    section.blocks.emplace_back(std::move(table));
  }
  if (auto table = coefficients_of(source, model->body); !table.rows.empty()) {
    section.blocks.emplace_back(std::move(table));
  }
  return section;
}

}  // namespace zerodrift::report
