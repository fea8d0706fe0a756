// The table in the controller before and after, entry by entry with the difference.

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

/// The number a stored entry begins with: 0.893 of "0.893 um/K from 21.54 C"; 0 for an entry that was not there.
double leading_number(const std::string& entry) {
  if (entry == "-") return 0.0;
  char* end = nullptr;
  const double value = std::strtod(entry.c_str(), &end);
  return end == entry.c_str() ? std::nan("") : value;
}

/// "X" and "T13 Z screw nut" of "X T13_C".
std::pair<std::string, std::string> parts_of(const Source& source, const std::string& what) {
  const std::size_t space = what.find(' ');
  if (space == std::string::npos) return {what, ""};
  const std::string entry = what.substr(space + 1);
  return {what.substr(0, space), entry.ends_with("_C") ? source.channel_in_words(entry) : source.say(entry)};
}

Table difference_of(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "table_difference";
  table.title = source.say("Old and new table: the error each entry predicts; the controller moves against it");
  table.header = {source.say("axis"), source.say("entry"), source.say("old"), source.say("new"),
                  source.say("difference")};
  table.trace = source.at("upload", "/difference");
  int number = 0;
  for (const auto& row : list_of(body, "difference")) {
    const std::string what = text_of(row, "what");
    const std::string pointer = fmt::format("/difference/{}", number++);
    const auto [axis, entry] = parts_of(source, what);
    const std::string name = what.substr(0, what.rfind("_C") == what.size() - 2 ? what.size() - 2 : what.size());
    std::string id = "table_" + name;
    for (char& c : id) c = c == ' ' ? '_' : c;
    const double change = leading_number(text_of(row, "new")) - leading_number(text_of(row, "old"));
    const int digits = what.ends_with("_C") ? 3 : what.ends_with("points") ? 0 : 2;
    table.rows.push_back({axis, entry, source.in_words(text_of(row, "old")),
                          Cell(source.in_words(text_of(row, "new")), id, source.at("upload", pointer + "/new")),
                          Cell(shown(change, digits), id + "_change", source.at("upload", pointer))});
  }
  return table;
}

/// Where a table holds more than one position: the compensation along the axis, before and after.
void add_curves(const Source& source, const nlohmann::json& body, Section& section) {
  int number = 0;
  for (const auto& axis : list_of(object_of(body, "record"), "difference")) {
    const std::string pointer = fmt::format("/record/difference/{}", number++);
    const auto points = list_of(axis, "compensation");
    if (points.size() < 2) continue;
    Plot plot;
    plot.id = "compensation_" + text_of(axis, "axis");
    plot.title =
        source.tell("Compensation along {}, old and new, at the temperatures of the upload", text_of(axis, "axis"));
    plot.x_label = "mm";
    plot.y_label = "µm";
    plot.width = Width::half;
    const auto add = [&](const char* key, const char* name, Stroke stroke, Hue hue) {
      Curve curve{source.say(name), {}, {}, false, hue, stroke};
      for (const auto& point : points) {
        curve.x.push_back(number_of(point, "position_mm"));
        curve.y.push_back(number_of(point, key));
      }
      plot.curves.push_back(std::move(curve));
    };
    const Hue hue = hue_of("d" + text_of(axis, "axis") + "_um");
    add("old_up_um", "old", Stroke::dashed, Hue::muted);
    add("new_up_um", "new, upwards", Stroke::solid, hue);
    add("new_down_um", "new, downwards", Stroke::thin, hue);
    plot.trace = source.at("upload", pointer);
    section.blocks.emplace_back(std::move(plot));
  }
}

}  // namespace

std::optional<Section> table_section(const Source& source) {
  const LoadedArtefact* upload = source.find("upload");
  if (upload == nullptr) return std::nullopt;
  Section section{"table", source.say("Compensation table, old and new"), {}};
  if (auto table = difference_of(source, upload->body); !table.rows.empty()) {
    section.blocks.emplace_back(std::move(table));
  }
  add_curves(source, upload->body, section);
  if (section.blocks.empty()) return std::nullopt;
  return section;
}

}  // namespace zerodrift::report
