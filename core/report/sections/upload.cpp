// What was written to the controller, and how.

#include <algorithm>

#include "core/report/build.h"

namespace zerodrift::report {

/// "reading back" of "reading_back".
static std::string words_of(std::string state) {
  std::replace(state.begin(), state.end(), '_', ' ');
  return state;
}

std::optional<Section> upload_section(const Source& source) {
  const LoadedArtefact* upload = source.find("upload");
  if (upload == nullptr) return std::nullopt;
  const auto& body = upload->body;
  Section section{"upload", source.say("Written to the controller"), {}};
  Figures figures;
  const auto add = [&](const char* id, const char* label, const std::string& value, const char* unit) {
    figures.figures.push_back({id, source.say(label), value, unit, "", Verdict::none, source.trace("upload", id)});
  };
  add("table_version", "Version of the table", text_of(body, "version"), "");
  add("table_crc", "Checksum, read back", text_of(body, "crc32"), "");
  add("table_registers", "Registers written", text_of(body, "registers"), "");
  add("largest_change_um", "Largest change against the old table", shown(number_of(body, "largest_change_um"), 1),
      "µm");
  section.blocks.emplace_back(std::move(figures));
  Table difference;
  difference.id = "table_difference";
  difference.title = source.say("Old and new table: the error each entry predicts; the controller moves against it");
  difference.header = {source.say("entry"), source.say("old"), source.say("new")};
  difference.trace = source.trace("upload", "difference");
  for (const auto& row : body.value("difference", nlohmann::json::array())) {
    difference.rows.push_back({source.in_words(text_of(row, "what")), source.in_words(text_of(row, "old")),
                               source.in_words(text_of(row, "new"))});
  }
  if (!difference.rows.empty()) section.blocks.emplace_back(std::move(difference));
  Table states;
  states.id = "transaction";
  states.title = source.say("Transaction");
  states.header = {source.say("state"), source.say("at, s"), source.say("result")};
  states.trace = source.trace("upload", "states");
  for (const auto& row : body.value("states", nlohmann::json::array())) {
    states.rows.push_back(
        {words_of(text_of(row, "state")), shown(number_of(row, "at_s"), 2), source.in_words(text_of(row, "detail"))});
  }
  if (!states.rows.empty()) section.blocks.emplace_back(std::move(states));
  return section;
}

}  // namespace zerodrift::report
