// Which sensors were kept and why.

#include "core/report/build.h"

namespace zerodrift::report {
namespace {

/// The sensitive points are only one of the sets that were compared: the sentence says which set it was, and why.
std::string how_chosen(const Source& source, const nlohmann::json& body) {
  std::string text = source.say(
      "Sensors that behave alike form a cluster (k-means++ on their series); in each, the one that follows the errors "
      "best is its sensitive point.");
  if (text_of(body, "chosen_by") == "hand") return text + " " + source.say("The sensors kept were chosen by hand.");
  const std::string reason = text_of(body.value("choice", nlohmann::json::object()), "reason");
  if (reason == "-") return text;  // a job of an older version
  return text + " " + source.say("These points were compared with other sets:") + " " + source.in_words(reason) + ".";
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
  section.blocks.emplace_back(
      Text{source.say("Kept for the model:") + " " + chosen + ". " + how_chosen(source, sensors->body), false});
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
