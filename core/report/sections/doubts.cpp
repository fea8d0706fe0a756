// Everything that was refused or looked doubtful on the way; an empty list is said, too.

#include "core/report/build.h"

namespace zerodrift::report {

std::optional<Section> doubts_section(const Source& source) {
  Section section{"doubts", source.say("Refused or doubtful"), {}};
  for (const auto& [kind, artefact] : source.artefacts()) {
    for (const auto& problem : artefact.body.value("problems", nlohmann::json::array())) {
      section.blocks.emplace_back(
          Text{kind + ": " + (problem.is_string() ? problem.get<std::string>() : problem.dump()), true});
    }
  }
  if (!source.audit_is_whole()) {
    section.blocks.emplace_back(Text{source.say("The record of writes to the machine was changed afterwards."), true});
  }
  if (section.blocks.empty()) {
    section.blocks.emplace_back(Text{source.say("Nothing was refused and nothing looked doubtful."), false});
  }
  return section;
}

}  // namespace zerodrift::report
