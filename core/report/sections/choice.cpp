// Why these sensors: what other sets would have left, and what each further sensor would bring.

#include <fmt/format.h>

#include <cmath>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

Table sets_of(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "sets";
  table.title = source.say("Sets of sensors tried, error on unseen stretches");
  table.header = {source.say("set"),
                  source.say("sensors"),
                  source.say("RMS, µm"),
                  source.say("largest, µm"),
                  source.say("to be expected, µm"),
                  source.say("taken")};
  table.trace = source.at("sensors", "/choice/sets");
  int number = 0;
  for (const auto& set : list_of(object_of(body, "choice"), "sets")) {
    const std::string pointer = fmt::format("/choice/sets/{}/", number++);
    const auto value = [&](const char* key) {
      return cell(number_of(set, key), 2, fmt::format("set_{}_{}", number, key), source.at("sensors", pointer + key));
    };
    table.rows.push_back({source.say(text_of(set, "in_words")), std::to_string(list_of(set, "sensors").size()),
                          value("held_out_rms_um"), value("held_out_peak_um"), value("expected_um"),
                          set.value("chosen", false) ? source.say("yes") : ""});
  }
  return table;
}

Plot budget_of(const Source& source, const nlohmann::json& body) {
  Plot plot;
  plot.id = "sensor_budget";
  plot.title = source.say("Error on unseen stretches against number of sensors");
  plot.x_label = source.say("sensors");
  plot.y_label = "µm";
  Curve rms{source.say("RMS"), {}, {}, false};
  Curve peak{source.say("largest"), {}, {}, false};
  for (const auto& point : list_of(body, "budget")) {
    const double count = number_of(point, "sensors");
    rms.x.push_back(count);
    rms.y.push_back(number_of(point, "held_out_rms_um"));
    peak.x.push_back(count);
    peak.y.push_back(number_of(point, "held_out_peak_um"));
  }
  plot.curves = {std::move(rms), std::move(peak)};
  plot.trace = source.at("sensors", "/budget");
  return plot;
}

Figures price_of(const Source& source, const nlohmann::json& body) {
  Figures figures;
  const auto price = object_of(body, "price");
  const auto add = [&](const char* id, const char* label, double value, int digits, const char* unit,
                       const char* pointer) {
    if (!std::isfinite(value)) return;
    figures.figures.push_back(figure(id, source.say(label), shown(value, digits), unit, source.at("sensors", pointer)));
  };
  add("sensors_kept", "Sensors kept", static_cast<double>(list_of(body, "chosen").size()), 0, "", "/chosen");
  add("kept_rms_um", "RMS on unseen stretches with those kept", number_of(price, "held_out_rms_um"), 2, "µm",
      "/price/held_out_rms_um");
  add("all_rms_um", "RMS on unseen stretches with all", number_of(price, "all_rms_um"), 2, "µm", "/price/all_rms_um");
  add("condition_number", "Condition number of those kept", number_of(body, "condition_number", "chosen"), 0, "",
      "/condition_number/chosen");
  return figures;
}

}  // namespace

std::optional<Section> choice_section(const Source& source) {
  const LoadedArtefact* sensors = source.find("sensors");
  if (sensors == nullptr) return std::nullopt;
  Section section{"choice", source.say("Why these sensors"), {}};
  const std::string by = text_of(sensors->body, "chosen_by");
  if (by == "hand")
    section.blocks.emplace_back(Text{source.say("The sensors were chosen by hand."), false});
  else if (text_of(object_of(sensors->body, "choice"), "reason").find("one cycle") != std::string::npos)
    section.blocks.emplace_back(
        Text{source.say("One cycle cannot rank the sets (a second speed would): fits on the first "
                        "few are averaged, and what the run leaves open is filled by how "
                        "machines are built."),
             false});
  if (auto figures = price_of(source, sensors->body); !figures.figures.empty()) {
    section.blocks.emplace_back(std::move(figures));
  }
  if (auto table = sets_of(source, sensors->body); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  if (auto plot = budget_of(source, sensors->body); plot.curves.front().x.size() > 1) {
    section.blocks.emplace_back(std::move(plot));
  }
  if (section.blocks.empty()) return std::nullopt;
  return section;
}

}  // namespace zerodrift::report
