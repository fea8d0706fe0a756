// The heat simulation beside the recording: what it left out, where that shows, what it is, what else it could be, and
// how much better the simulation fits with it.

#include <fmt/format.h>

#include <cmath>

#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/answer/sentences.h"
#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

using nlohmann::json;

/// "step = 3.1 ± 0.2 µm, t = 40 min" with its words said; the signs of quantities stay.
std::string said_parameters(const Source& source, const std::string& parameters) {
  std::string out;
  std::size_t from = 0;
  while (from < parameters.size()) {
    const std::size_t comma = std::min(parameters.find(", ", from), parameters.size());
    const std::string one = parameters.substr(from, comma - from);
    const std::size_t equals = one.find(" = ");
    out += out.empty() ? "" : ", ";
    out += equals == std::string::npos ? one : source.say(one.substr(0, equals)) + source.say(one.substr(equals));
    from = comma + 2;
  }
  return out;
}

/// A stored sentence in the reader's language; `english` for jobs that keep nothing but the text.
std::string said_here(const Source& source, const json& stored, const std::string& english) {
  auto sentence = diagnosis::sentence_from_json(stored);
  for (auto& [key, fact] : sentence.facts) {
    if (key == "component" || key == "part") fact = source.say(fact);
    if (key == "parameters") fact = said_parameters(source, fact);
  }
  const std::string text = diagnosis::said(sentence, [&](const std::string& words) { return source.say(words); });
  return text.empty() ? source.in_words(english) : source.with_names(text);
}

/// The sentences of an object that keeps them as "said" and in English as "sentences".
void add_sentences(const json& body, const Source& source, bool warning, Section& section) {
  const auto english = list_of(body, "sentences");
  const auto stored = list_of(body, "said");
  for (std::size_t i = 0; i < english.size(); ++i) {
    const auto one = i < stored.size() ? stored[i] : json();
    section.blocks.emplace_back(Text{said_here(source, one, english[i].get<std::string>()), warning});
  }
}

std::string said_of(const Source& source, const json& one, const char* key) {
  return said_here(source, one.value("said", json()), text_of(one, key));
}

/// Where, when and how large: what the search located before it named anything.
void add_place(const json& diagnosis, const Source& source, Section& section) {
  const auto mismatch = object_of(diagnosis, "mismatch");
  if (mismatch.empty() || text_of(diagnosis, "verdict") == "consistent") return;
  const std::string root = "/diagnosis/mismatch/";
  std::string channels;
  for (const auto& channel : list_of(mismatch, "channels")) {
    channels += (channels.empty() ? "" : ", ") + source.channel_in_words(channel.get<std::string>());
  }
  const auto place = list_of(mismatch, "position_mm");
  Table table;
  table.id = "located";
  table.title = source.say("Where the simulation and the recording disagree");
  table.header = {source.say("what"), source.say("figure")};
  table.trace = source.at("physics", "/diagnosis/mismatch");
  table.rows.push_back({source.say("channels"), channels.empty() ? "-" : channels});
  table.rows.push_back({source.say("component"), source.say(text_of(mismatch, "component"))});
  if (place.size() == 2) {
    table.rows.push_back(
        {source.say("from its fixed end, mm"),
         Cell(source.tell("{} to {}", shown(place[0].get<double>(), 0), shown(place[1].get<double>(), 0)),
              "mismatch_position_mm", source.at("physics", root + "position_mm"))});
  }
  table.rows.push_back({source.say("when"), source.say(text_of(mismatch, "regime"))});
  table.rows.push_back({source.say("missing heat, W"), cell(number_of(mismatch, "missing_heat_W"), 1, "missing_heat_W",
                                                            source.at("physics", root + "missing_heat_W"))});
  section.blocks.emplace_back(std::move(table));
}

void add_heat_map(const json& body, const Source& source, Section& section) {
  const auto heat = object_of(body, "heat");
  HeatMap map;
  for (const auto& row : list_of(heat, "watts")) {
    std::vector<double> values;
    for (const auto& w : row) values.push_back(w.is_number() ? w.get<double>() : std::nan(""));
    map.rows.push_back(std::move(values));
  }
  if (map.rows.empty() || map.rows.front().empty()) return;
  map.id = "missing_heat";
  map.title = source.tell("Missing heat over position and time: {}", source.say(text_of(heat, "component")));
  map.x_label = source.say("hours");
  map.y_label = source.say("mm from the fixed end");
  map.unit = "W";
  map.x_from = number_of(heat, "from_s") / 3600.0;
  map.x_to = number_of(heat, "to_s") / 3600.0;
  map.y_from = number_of(heat, "from_mm");
  map.y_to = number_of(heat, "to_mm");
  if (const auto* machine = source.find("machine")) {
    for (const auto& sensor : list_of(object_of(object_of(machine->body, "profile"), "machine"), "sensors")) {
      const double at = number_of(sensor, "position_mm");
      if (!std::isfinite(at) || text_of(sensor, "component") != text_of(heat, "component")) continue;
      const std::string channel = text_of(sensor, "channel");
      map.ticks.emplace_back(at, channel.substr(0, channel.find('_')));
    }
  }
  map.trace = source.at("physics", "/heat");
  section.blocks.emplace_back(std::move(map));
}

/// What was left out, what cannot be excluded and which run would decide.
void add_answer(const json& diagnosis, const Source& source, Section& section) {
  add_sentences(diagnosis, source, text_of(diagnosis, "verdict") == "unexplained", section);
  for (const auto& effect : list_of(diagnosis, "effects")) {
    std::string text = said_of(source, effect, "explanation");
    const double confidence = number_of(effect, "confidence");
    if (std::isfinite(confidence)) text += " " + source.tell("Confidence: {} %.", shown(100.0 * confidence, 0));
    section.blocks.emplace_back(Text{text, false});
  }
  const auto rivals = list_of(diagnosis, "ambiguous_with");
  for (const auto& rival : rivals) section.blocks.emplace_back(Text{said_of(source, rival, "why"), false});
  if (rivals.empty() && !list_of(diagnosis, "effects").empty()) {
    section.blocks.emplace_back(
        Text{source.say("No other effect of the library explains this recording nearly as well."), false});
  }
  const auto experiment = diagnosis.value("suggested_experiment", json());
  if (experiment.is_object()) section.blocks.emplace_back(Text{said_of(source, experiment, "text"), false});
}

Table effects_of(const json& diagnosis, const Source& source) {
  Table table;
  table.id = "effects";
  table.title = source.say("Effects found, with their parameters");
  table.header = {source.say("effect"), source.say("parameters"), source.say("confidence, %"),
                  source.say("gain of log evidence")};
  table.trace = source.at("physics", "/diagnosis/effects");
  int number = 0;
  for (const auto& effect : list_of(diagnosis, "effects")) {
    const std::string pointer = fmt::format("/diagnosis/effects/{}/", number++);
    std::string parameters;
    const auto sigma = object_of(effect, "sigma");
    const auto values = object_of(effect, "parameters");
    for (const auto& [key, value] : values.items()) {
      if (!value.is_number()) continue;
      const double width = number_of(sigma, key);
      const double at_rpm = number_of(object_of(effect, "at_rpm"), key);
      const auto one = diagnosis::parameter_in_words(key, value.get<double>(), std::isfinite(width) ? width : 0.0,
                                                     std::isfinite(at_rpm) ? at_rpm : 0.0);
      if (!one.empty()) parameters += (parameters.empty() ? "" : ", ") + one;
    }
    table.rows.push_back({source.say(diagnosis::plain_name(text_of(effect, "id"))), said_parameters(source, parameters),
                          cell(100.0 * number_of(effect, "confidence"), 0, fmt::format("effect_{}_confidence", number),
                               source.at("physics", pointer + "confidence")),
                          cell(number_of(effect, "log_evidence_gain"), 1, fmt::format("effect_{}_evidence", number),
                               source.at("physics", pointer + "log_evidence_gain"))});
  }
  return table;
}

Table rmse_table(const Source& source, const json& body) {
  Table table;
  table.id = "simulation_rmse";
  table.title = source.say("Simulation against recording, RMS difference");
  table.trace = source.at("physics", "/rmse");
  const auto searched = object_of(object_of(body, "diagnosis"), "rmse");
  const auto refitted = object_of(searched, "refitted");
  const auto after = object_of(searched, "after");
  const auto noise = object_of(searched, "noise");
  const auto unseen = object_of(searched, "held_out_refitted");
  const auto unseen_after = object_of(searched, "held_out_after");
  table.header = {source.say("channel"), source.say("as described"), source.say("re-fitted without"),
                  source.say("with what was found"), source.say("noise of the sensor")};
  if (!unseen_after.empty()) {
    table.header.push_back(source.say("unseen, without"));
    table.header.push_back(source.say("unseen, with"));
  }
  table.header.push_back(source.say("unit"));
  const auto before = object_of(object_of(body, "rmse"), "before");
  for (const auto& [channel, value] : before.items()) {
    if (!value.is_number()) continue;
    const std::string name = channel.substr(0, channel.find('_'));
    const auto part = [&, &channel = channel](const json& of, const char* key) {
      return cell(number_of(of, channel), 2, fmt::format("rmse_{}_{}", key, name),
                  source.at("physics", fmt::format("/diagnosis/rmse/{}/{}", key, channel)));
    };
    std::vector<Cell> row = {
        source.channel_in_words(channel),
        cell(value.get<double>(), 2, "rmse_before_" + name, source.at("physics", "/rmse/before/" + channel)),
        part(refitted, "refitted"), part(after, "after"), part(noise, "noise")};
    if (!unseen_after.empty()) {
      row.push_back(part(unseen, "held_out_refitted"));
      row.push_back(part(unseen_after, "held_out_after"));
    }
    row.emplace_back(recording::kind_of(channel) == recording::ChannelKind::error ? "µm" : "K");
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Each channel's own verdict, and when one that stays unexplained is off; answers of earlier versions have none.
Table verdicts_of(const Source& source, const json& diagnosis) {
  Table table;
  table.id = "channel_verdicts";
  table.title = source.say("What is left, by channel");
  table.header = {source.say("channel"), source.say("verdict"), source.say("when, min"), source.say("missing heat, W")};
  table.trace = source.at("physics", "/diagnosis/channels");
  int number = 0;
  for (const auto& channel : list_of(diagnosis, "channels")) {
    const std::string pointer = fmt::format("/diagnosis/channels/{}/", number++);
    const std::string verdict = text_of(channel, "verdict");
    if (verdict.empty()) continue;
    std::string when;
    for (const auto& span : list_of(channel, "time_s")) {
      if (verdict != "unexplained" || span.size() != 2) continue;
      when += (when.empty() ? "" : ", ") +
              fmt::format("{:.0f}–{:.0f}", span[0].get<double>() / 60.0, span[1].get<double>() / 60.0);
    }
    const double watts = verdict == "unexplained" ? number_of(channel, "missing_heat_W") : 0.0;
    const std::string name = text_of(channel, "channel");
    table.rows.push_back(
        {source.channel_in_words(name), source.say(verdict), when.empty() ? "-" : when,
         watts == 0.0 || !std::isfinite(watts)
             ? Cell("-")
             : cell(watts, 1, "missing_heat_" + name, source.at("physics", pointer + "missing_heat_W"))});
  }
  return table;
}

/// The likeliest explanations, and how far the others are behind.
Table tried_of(const Source& source, const json& diagnosis) {
  constexpr std::size_t most = 6;
  Table table;
  table.id = "tried";
  table.title = source.say("What was tried");
  table.header = {source.say("explanation"), source.say("probability, %"), source.say("behind, log odds")};
  table.trace = source.at("physics", "/diagnosis/tried");
  int number = 0;
  for (const auto& one : list_of(diagnosis, "tried")) {
    if (table.rows.size() == most) break;
    const std::string pointer = fmt::format("/diagnosis/tried/{}/", number);
    std::string parts;
    const auto add = [&](const std::string& part) { parts += (parts.empty() ? "" : ", ") + source.say(part); };
    for (const auto& id : list_of(one, "effects")) add(diagnosis::plain_name(id.get<std::string>()));
    if (!list_of(one, "mistakes").empty()) add("a mistake in the description");
    table.rows.push_back({parts.empty() ? source.say("as described") : parts,
                          cell(100.0 * number_of(one, "probability"), 0, fmt::format("tried_{}_probability", number),
                               source.at("physics", pointer + "probability")),
                          cell(number_of(one, "behind"), 1, fmt::format("tried_{}_behind", number),
                               source.at("physics", pointer + "behind"))});
    ++number;
  }
  return table;
}

/// What would have been found had it been there: the smallest that this recording shows.
Table detectable(const Source& source, const json& diagnosis) {
  Table table;
  table.id = "detectable";
  table.title = source.say("Smallest effects that this recording would have shown");
  table.header = {source.say("effect"), source.say("from")};
  table.trace = source.at("physics", "/diagnosis/could_have_detected");
  const auto all = object_of(diagnosis, "could_have_detected");
  for (const auto& [effect, least] : all.items()) {
    const auto text = diagnosis::parameter_in_words(text_of(least, "key"), number_of(least, "value"), 0.0,
                                                    least.value("at_rpm", 0.0));
    table.rows.push_back(
        {source.say(diagnosis::plain_name(effect)),
         Cell(text.empty() ? shown(number_of(least, "value"), 4) : said_parameters(source, text),
              "detectable_" + effect, source.at("physics", "/diagnosis/could_have_detected/" + effect + "/value"))});
  }
  return table;
}

Curve curve_from(const json& one, const char* key, const std::string& name, Hue hue) {
  Curve curve{name, {}, {}, false, hue};
  const auto hours = list_of(one, "time_h");
  const auto values = list_of(one, key);
  for (const auto& x : hours) curve.x.push_back(x.get<double>());
  for (const auto& y : values) curve.y.push_back(y.is_number() ? y.get<double>() : std::nan(""));
  curve.y.resize(curve.x.size(), std::nan(""));
  return curve;
}

Plot simulation_plot(const json& one, const recording::Recording* run, const Source& source, int number) {
  Plot plot;
  const std::string channel = text_of(one, "channel");
  plot.id = "simulation_" + channel;
  plot.title = source.channel_in_words(channel);
  plot.x_label = source.say("hours");
  plot.y_label = text_of(one, "unit") == "C" ? "°C" : "µm";
  plot.width = Width::half;
  if (run != nullptr) {
    plot.curves = curves_of(*run, {channel}, false);
    for (auto& curve : plot.curves) {
      curve.name = source.say("recorded");
      curve.hue = Hue::muted;
    }
  }
  plot.curves.push_back(curve_from(one, "values", source.say("simulated"), Hue::x));
  plot.curves.back().stroke = Stroke::dashed;
  if (one.contains("refined")) {
    plot.curves.push_back(curve_from(one, "refined", source.say("with what was found"), Hue::z));
  }
  plot.trace = source.at("physics", fmt::format("/curves/{}", number));
  return plot;
}

}  // namespace

void add_verdict_of_physics(const Source& source, Section& section) {
  const LoadedArtefact* physics = source.find("physics");
  if (physics == nullptr) return;
  const auto diagnosis = object_of(physics->body, "diagnosis");
  add_sentences(diagnosis, source, text_of(diagnosis, "verdict") == "unexplained", section);
}

std::optional<Section> physics_section(const Source& source) {
  const LoadedArtefact* physics = source.find("physics");
  if (physics == nullptr) return std::nullopt;
  Section section{"physics", source.say("Physics: simulation against recording"), {}};
  const auto& body = physics->body;
  const auto diagnosis = object_of(body, "diagnosis");
  if (!diagnosis.empty()) add_answer(diagnosis, source, section);
  add_sentences(body, source, false, section);
  if (!diagnosis.empty()) add_place(diagnosis, source, section);
  add_heat_map(body, source, section);
  if (auto table = effects_of(diagnosis, source); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  if (auto table = rmse_table(source, body); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  if (auto table = verdicts_of(source, diagnosis); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  if (auto table = tried_of(source, diagnosis); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  const auto* run = source.run_of("warmup");
  const auto curves = list_of(body, "curves");
  if (!curves.empty()) {
    section.blocks.emplace_back(Text{source.say("Recorded and simulated, channel by channel:"), false});
  }
  int number = 0;
  for (const auto& one : curves) section.blocks.emplace_back(simulation_plot(one, run, source, number++));
  if (auto table = detectable(source, diagnosis); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace zerodrift::report
