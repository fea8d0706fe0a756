// Axis errors: figures of ISO 230-2 and VDI/DGQ 3441, the points and what the segments leave.

#include <fmt/format.h>

#include <cmath>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

struct Named {
  const char* key;
  const char* sign;
  const char* words;
};

constexpr Named iso_figures[] = {
    {"A_um", "A", "accuracy, both directions"},        {"A_up_um", "A↑", "accuracy upwards"},
    {"A_down_um", "A↓", "accuracy downwards"},         {"E_um", "E", "systematic deviation"},
    {"E_up_um", "E↑", "systematic deviation upwards"}, {"E_down_um", "E↓", "systematic deviation downwards"},
    {"R_um", "R", "repeatability, both directions"},   {"R_up_um", "R↑", "repeatability upwards"},
    {"R_down_um", "R↓", "repeatability downwards"},    {"B_um", "B", "reversal, largest"},
    {"B_mean_um", "B mean", "reversal, mean"},         {"M_um", "M", "range of the mean deviation"}};
constexpr Named vdi_figures[] = {
    {"P_um", "P", "positional uncertainty"},     {"Pa_um", "Pa", "positional deviation"},
    {"Ps_max_um", "Ps max", "scatter, largest"}, {"Ps_mean_um", "Ps mean", "scatter, mean"},
    {"U_max_um", "U max", "reversal, largest"},  {"U_mean_um", "U mean", "reversal, mean"}};

template <std::size_t N>
Table figures_of(const Source& source, const nlohmann::json& statistics, const std::string& pointer,
                 const std::string& axis, const Named (&names)[N], const std::string& id, const std::string& title) {
  Table table;
  table.id = id + "_" + axis;
  table.title = title;
  table.header = {source.say("figure"), source.say("what"), "µm"};
  table.trace = source.at("axis_table", pointer);
  for (const Named& one : names) {
    table.rows.push_back({source.say(one.sign), source.say(one.words),
                          cell(number_of(statistics, one.key), 2, fmt::format("{}_{}_{}", id, axis, one.key),
                               source.at("axis_table", fmt::format("{}/{}", pointer, one.key)))});
  }
  return table;
}

/// The error at the targets and what the table's segments say of it.
Plot plot_of(const Source& source, const std::string& name, const nlohmann::json& axis) {
  Plot plot;
  plot.id = "axis_error_" + name;
  plot.title = source.tell("Error of axis {} and the segments that compensate it", name);
  plot.x_label = "mm";
  plot.y_label = "µm";
  const Hue hue = hue_of("d" + name + "_um");
  Curve up{source.say("upwards"), {}, {}, true, hue};
  Curve down{source.say("downwards"), {}, {}, true, Hue::muted};
  for (const auto& point : list_of(axis, "points")) {
    up.x.push_back(number_of(point, "position_mm"));
    up.y.push_back(number_of(point, "error_up_um"));
    down.x.push_back(number_of(point, "position_mm"));
    down.y.push_back(number_of(point, "error_down_um"));
  }
  plot.curves = {std::move(up), std::move(down)};
  Curve line{source.say("segments"), {}, {}, false, Hue::order};
  for (const auto& segment : list_of(axis, "segments")) {
    for (const char* end : {"from_mm", "to_mm"}) {
      const double at = number_of(segment, end);
      line.x.push_back(at);
      // measured = a * commanded + b, so the error in µm is 1000 ((a - 1) x + b).
      line.y.push_back(1000.0 * ((number_of(segment, "a") - 1.0) * at + number_of(segment, "b_mm")));
    }
  }
  if (!line.x.empty()) plot.curves.push_back(std::move(line));
  plot.trace = source.at("axis_table", "/table/axes/" + name);
  return plot;
}

Table segments_of(const Source& source, const std::string& name, const nlohmann::json& axis) {
  Table table;
  table.id = "segments_" + name;
  table.title = source.tell("Segments of axis {}: measured = a × commanded + b", name);
  table.header = {source.say("from, mm"), source.say("to, mm"), "a", "b, µm", "r", source.say("points")};
  table.trace = source.at("axis_table", "/table/axes/" + name + "/segments");
  int number = 0;
  for (const auto& segment : list_of(axis, "segments")) {
    const std::string pointer = fmt::format("/table/axes/{}/segments/{}", name, number++);
    table.rows.push_back({shown(number_of(segment, "from_mm"), 3), shown(number_of(segment, "to_mm"), 3),
                          cell(number_of(segment, "a"), 7, fmt::format("segment_{}_{}_a", name, number),
                               source.at("axis_table", pointer + "/a")),
                          cell(1000.0 * number_of(segment, "b_mm"), 2, fmt::format("segment_{}_{}_b_um", name, number),
                               source.at("axis_table", pointer + "/b_mm")),
                          shown(number_of(segment, "r"), 4), shown(number_of(segment, "points"), 0)});
  }
  return table;
}

/// By axis; jobs of earlier versions keep those of the last axis only.
std::map<std::string, std::pair<nlohmann::json, std::string>> statistics_of(const nlohmann::json& body) {
  std::map<std::string, std::pair<nlohmann::json, std::string>> by_axis;
  const auto kept = object_of(body, "statistics_by_axis");
  for (const auto& [name, statistics] : kept.items()) {
    by_axis[name] = {statistics, "/statistics_by_axis/" + name};
  }
  const auto axes = object_of(object_of(body, "table"), "axes");
  if (by_axis.empty() && axes.size() == 1 && body.contains("statistics")) {
    by_axis[axes.begin().key()] = {body.at("statistics"), "/statistics"};
  }
  return by_axis;
}

}  // namespace

std::optional<Section> axis_section(const Source& source) {
  const LoadedArtefact* artefact = source.find("axis_table");
  if (artefact == nullptr) return std::nullopt;
  Section section{"axis", source.say("Axis errors by ISO 230-2 and VDI/DGQ 3441"), {}};
  const std::string file = text_of(artefact->body, "file");
  section.blocks.emplace_back(Text{source.tell("From the laser report {}.", file), false});
  const auto statistics = statistics_of(artefact->body);
  const auto axes = object_of(object_of(artefact->body, "table"), "axes");
  for (const auto& [name, axis] : axes.items()) {
    section.blocks.emplace_back(plot_of(source, name, axis));
    const auto of_axis = statistics.find(name);
    if (of_axis != statistics.end()) {
      const auto& [values, pointer] = of_axis->second;
      section.blocks.emplace_back(
          figures_of(source, values, pointer, name, iso_figures, "iso230_2", source.tell("ISO 230-2, axis {}", name)));
      section.blocks.emplace_back(figures_of(source, values, pointer, name, vdi_figures, "vdi3441",
                                             source.tell("VDI/DGQ 3441, axis {}", name)));
    } else {
      section.blocks.emplace_back(
          Text{source.tell("The figures of axis {} are not in this job; only its table is.", name), true});
    }
    if (auto table = segments_of(source, name, axis); !table.rows.empty()) {
      section.blocks.emplace_back(std::move(table));
    }
  }
  for (const auto& note : list_of(artefact->body, "notes")) {
    if (note.is_string()) section.blocks.emplace_back(Text{source.in_words(note.get<std::string>()), false});
  }
  return section;
}

}  // namespace zerodrift::report
