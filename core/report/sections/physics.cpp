// The heat simulation beside the recording, and what it left out.

#include <cmath>

#include "core/diagnosis/sentences.h"
#include "core/report/build.h"

namespace zerodrift::report {
namespace {

Table rmse_table(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "simulation_rmse";
  table.title = source.say("Simulation against recording, RMS difference");
  table.trace = source.trace("physics", "rmse");
  const auto diagnosis = body.value("diagnosis", nlohmann::json::object());
  const auto rmse = body.value("rmse", nlohmann::json::object());
  const auto searched = diagnosis.value("rmse", nlohmann::json::object());
  const auto before = rmse.value("before", nlohmann::json::object());
  const auto part = [&](const char* key) { return searched.value(key, nlohmann::json::object()); };
  const auto refitted = part("refitted");
  const auto after = part("after");
  const auto noise = part("noise");
  table.header = {source.say("channel"), source.say("as described"), source.say("re-fitted without"),
                  source.say("with what was found"), source.say("noise of the sensor")};
  for (const auto& [channel, value] : before.items()) {
    if (!value.is_number()) continue;
    table.rows.push_back({source.channel_in_words(channel), shown(value.get<double>(), 2),
                          shown(number_of(refitted, channel), 2), shown(number_of(after, channel), 2),
                          shown(number_of(noise, channel), 2)});
  }
  return table;
}

/// A stored sentence in the reader's language; `english` for jobs that keep nothing but the text.
std::string in_words(const nlohmann::json& stored, const std::string& english, const Source& source) {
  const std::string text = diagnosis::said(diagnosis::sentence_from_json(stored),
                                           [&](const std::string& words) { return source.say(words.c_str()); });
  return source.in_words(text.empty() ? english : text);
}

/// The sentences of an object that keeps them as "said" and in English as "sentences".
void add_sentences(const nlohmann::json& body, const Source& source, bool warning, Section& section) {
  const auto english = body.value("sentences", nlohmann::json::array());
  const auto stored = body.value("said", nlohmann::json::array());
  for (std::size_t i = 0; i < english.size(); ++i) {
    const auto one = i < stored.size() ? stored[i] : nlohmann::json();
    section.blocks.emplace_back(Text{in_words(one, english[i].get<std::string>(), source), warning});
  }
}

/// What was left out, what cannot be excluded and which run would decide.
void add_answer(const nlohmann::json& diagnosis, const Source& source, Section& section) {
  add_sentences(diagnosis, source, text_of(diagnosis, "verdict") == "unexplained", section);
  const auto said = [&](const nlohmann::json& one, const char* key) {
    return in_words(one.value("said", nlohmann::json()), text_of(one, key), source);
  };
  for (const auto& effect : diagnosis.value("effects", nlohmann::json::array())) {
    std::string text = said(effect, "explanation");
    const double confidence = number_of(effect, "confidence");
    if (std::isfinite(confidence)) {
      text += " " + source.say("Confidence:") + " " + shown(100.0 * confidence, 0) + " %.";
    }
    section.blocks.emplace_back(Text{text, false});
  }
  for (const auto& rival : diagnosis.value("ambiguous_with", nlohmann::json::array())) {
    section.blocks.emplace_back(Text{said(rival, "why"), false});
  }
  const auto experiment = diagnosis.value("suggested_experiment", nlohmann::json());
  if (experiment.is_object()) section.blocks.emplace_back(Text{said(experiment, "text"), false});
}

Curve curve_of(const nlohmann::json& one, const char* key, const std::string& name) {
  Curve curve{name, {}, {}, false};
  const auto hours = one.value("time_h", nlohmann::json::array());
  const auto values = one.value(key, nlohmann::json::array());
  for (const auto& x : hours) curve.x.push_back(x.get<double>());
  for (const auto& y : values) curve.y.push_back(y.is_number() ? y.get<double>() : std::nan(""));
  return curve;
}

Plot plot_of(const nlohmann::json& one, const recording::Recording* run, const Source& source) {
  Plot plot;
  const std::string channel = text_of(one, "channel");
  plot.id = "simulation_" + channel;
  plot.title = source.say("Recorded and simulated:") + " " + source.channel_in_words(channel);
  plot.x_label = source.say("hours");
  plot.y_label = text_of(one, "unit") == "C" ? "°C" : source.in_words(text_of(one, "unit"));
  if (run != nullptr) {
    plot.curves = curves_of(*run, {channel}, false);
    for (auto& curve : plot.curves) curve.name = source.say("recorded");
  }
  plot.curves.push_back(curve_of(one, "values", source.say("simulated")));
  if (one.contains("refined")) plot.curves.push_back(curve_of(one, "refined", source.say("with what was found")));
  plot.trace = source.trace("physics", "curves " + channel);
  return plot;
}

}  // namespace

std::optional<Section> physics_section(const Source& source) {
  const LoadedArtefact* physics = source.find("physics");
  if (physics == nullptr) return std::nullopt;
  Section section{"physics", source.say("Physics: simulation against recording"), {}};
  const auto& body = physics->body;
  if (body.contains("diagnosis")) add_answer(body.at("diagnosis"), source, section);
  add_sentences(body, source, false, section);
  section.blocks.emplace_back(rmse_table(source, body));
  const auto* run = source.run_of("warmup");
  const auto curves = body.value("curves", nlohmann::json::array());
  for (const auto& one : curves) section.blocks.emplace_back(plot_of(one, run, source));
  return section;
}

}  // namespace zerodrift::report
