// Which sensors were kept and why.

#include <fmt/format.h>

#include <cmath>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

/// A row a sensor: its cluster, how it goes with each error, how much the others say already (VIF), and whether it is
/// kept.
Table clusters_of(const Source& source, const nlohmann::json& body) {
  Table table;
  table.id = "clusters";
  table.title = source.say("Clusters and correlation with the errors");
  const bool absolute = text_of(object_of(body, "criterion"), "used") == "absolute";
  const std::string sum =
      absolute ? source.say("sum of correlations, absolute") : source.say("sum of correlations, with sign");
  const auto errors = body.value("errors", std::vector<std::string>{"dX_um", "dY_um", "dZ_um"});
  table.header = {source.say("sensor"), source.say("cluster")};
  for (const auto& error : errors) table.header.push_back("r(" + tag_of(error, source.labels()) + ")");
  for (const auto& head : {sum, std::string("VIF"), source.say("kept")}) table.header.push_back(head);
  table.trace = source.at("sensors", "/table");
  std::map<std::string, nlohmann::json> details;
  for (const auto& one : list_of(body, "sensors")) details[text_of(one, "sensor")] = one;
  int number = 0;
  for (const auto& row : list_of(body, "table")) {
    const std::string channel = text_of(row, "channel");
    const auto& detail = details[channel];
    const auto correlation = detail.is_object() ? object_of(detail, "correlation") : nlohmann::json::object();
    const double vif = detail.is_object() ? number_of(detail, "vif") : std::nan("");
    const std::string pointer = fmt::format("/table/{}/correlation_sum", number++);
    std::vector<Cell> cells = {source.channel_in_words(channel), text_of(row, "cluster")};
    for (const auto& error : errors) cells.push_back(shown(number_of(correlation, error), 2));
    cells.push_back(cell(number_of(row, "correlation_sum"), 3, "correlation_" + channel.substr(0, channel.rfind('_')),
                         source.at("sensors", pointer)));
    cells.push_back(shown(vif, 0));
    cells.push_back(row.value("kept", false) ? source.say("yes") : "");
    table.rows.push_back(std::move(cells));
  }
  return table;
}

}  // namespace

std::optional<Section> sensors_section(const Source& source) {
  const LoadedArtefact* sensors = source.find("sensors");
  if (sensors == nullptr) return std::nullopt;
  Section section{"sensors", source.say("Sensors"), {}};
  std::string chosen;
  for (const auto& one : sensors->body.value("chosen", nlohmann::json::array())) {
    chosen += (chosen.empty() ? "" : ", ") + source.channel_in_words(one.get<std::string>());
  }
  section.blocks.emplace_back(Text{
      source.say("Kept for the model:") + " " + chosen + ". " +
          source.say("Sensors that behave alike form a cluster (k-means++ on their series); in each, the one that "
                     "follows the errors best is its sensitive point. How the set was chosen is in the next part."),
      false});
  section.blocks.emplace_back(clusters_of(source, sensors->body));
  return section;
}

}  // namespace zerodrift::report
