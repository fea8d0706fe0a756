// Which sensors were kept and why.

#include "core/report/build.h"

namespace zerodrift::report {

std::optional<Section> sensors_section(const Source& source) {
  const LoadedArtefact* sensors = source.find("sensors");
  if (sensors == nullptr) return std::nullopt;
  Section section{"sensors", source.say("Sensors"), {}};
  std::string chosen;
  for (const auto& one : sensors->body.value("chosen", nlohmann::json::array())) {
    chosen += (chosen.empty() ? "" : ", ") + source.channel_in_words(one.get<std::string>());
  }
  section.blocks.emplace_back(Text{source.say("Kept for the model:") + " " + chosen + ". " +
                                       source.say("In each cluster of sensors that behave alike (k-means++ on their "
                                                  "series) the one that follows the errors best is kept."),
                                   false});
  Table table;
  table.id = "clusters";
  table.title = source.say("Clusters and correlation with the errors");
  table.header = {source.say("sensor"), source.say("cluster"), source.say("sum of correlations"), source.say("kept")};
  table.trace = source.trace("sensors", "sensors");
  for (const auto& row : sensors->body.value("table", nlohmann::json::array())) {
    table.rows.push_back({source.channel_in_words(text_of(row, "channel")), text_of(row, "cluster"),
                          shown(number_of(row, "correlation_sum"), 3),
                          row.value("kept", false) ? source.say("yes") : ""});
  }
  section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace zerodrift::report
