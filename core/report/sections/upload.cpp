// How the table was written: the sign check before it, the transaction, and what the controller holds now.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

/// "reading back" of "reading_back".
std::string words_of(std::string state) {
  std::replace(state.begin(), state.end(), '_', ' ');
  return state;
}

Figures figures_of(const Source& source, const nlohmann::json& body) {
  Figures figures;
  const auto add = [&](const char* id, const char* label, const std::string& value, const char* unit,
                       const char* pointer) {
    figures.figures.push_back(figure(id, source.say(label), value, unit, source.at("upload", pointer)));
  };
  add("table_version", "Version of the table", text_of(body, "version"), "", "/version");
  add("table_crc", "Checksum, read back", text_of(body, "crc32"), "", "/crc32");
  add("table_registers", "Registers written", text_of(body, "registers"), "", "/registers");
  add("largest_change_um", "Largest change against the old table", shown(number_of(body, "largest_change_um"), 1), "µm",
      "/largest_change_um");
  return figures;
}

Table signs_of(const Source& source, const nlohmann::json& check) {
  Table table;
  table.id = "signs";
  table.title = source.say("Sign check: a test offset in each axis, watched before the table was written");
  table.header = {source.say("axis"), source.say("commanded, µm"), source.say("seen, µm"),
                  source.say("uncertainty, µm"), source.say("result")};
  table.trace = source.at("upload", "/sign_check");
  int number = 0;
  for (const auto& axis : list_of(check, "axes")) {
    const std::string name = text_of(axis, "axis");
    const std::string pointer = fmt::format("/sign_check/axes/{}", number++);
    const std::size_t own = std::string("XYZ").find(name);
    const auto part = [&](const char* key) {
      const auto list = list_of(axis, key);
      return own < list.size() && list[own].is_number() ? list[own].get<double>() : std::nan("");
    };
    const bool watched = axis.value("watched", false);
    table.rows.push_back({name, shown(number_of(axis, "commanded_um"), 1),
                          cell(watched ? part("seen_um") : std::nan(""), 2, "sign_seen_" + name + "_um",
                               source.at("upload", fmt::format("{}/seen_um/{}", pointer, own))),
                          shown(watched ? part("sigma_um") : std::nan(""), 2),
                          source.say(!watched                       ? "not watched: the source does not see this axis"
                                     : check.value("passed", false) ? "moves as commanded"
                                                                    : "check failed")});
  }
  return table;
}

}  // namespace

std::optional<Section> upload_section(const Source& source) {
  const LoadedArtefact* upload = source.find("upload");
  if (upload == nullptr) return std::nullopt;
  const auto& body = upload->body;
  Section section{"upload", source.say("Written to the controller"), {}};
  section.blocks.emplace_back(figures_of(source, body));
  const auto check = object_of(body, "sign_check");
  if (auto table = signs_of(source, check); !table.rows.empty()) section.blocks.emplace_back(std::move(table));
  Table states;
  states.id = "transaction";
  states.title = source.say("Transaction");
  states.header = {source.say("state"), source.say("at, s"), source.say("result")};
  states.trace = source.at("upload", "/states");
  for (const auto& row : list_of(body, "states")) {
    states.rows.push_back({source.say(words_of(text_of(row, "state"))), shown(number_of(row, "at_s"), 2),
                           source.in_words(text_of(row, "detail"))});
  }
  if (!states.rows.empty()) section.blocks.emplace_back(std::move(states));
  return section;
}

}  // namespace zerodrift::report
