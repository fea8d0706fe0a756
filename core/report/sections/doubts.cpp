// Everything that was refused or looked doubtful on the way; an empty list is said, too.

#include "core/report/doubts.h"

#include "core/report/build.h"

namespace zerodrift::report {

std::optional<Section> doubts_section(const Source& source) {
  Section section{"doubts", source.say("Refused or doubtful"), {}};
  for (auto& doubt : doubts_of(source)) {
    section.blocks.emplace_back(Text{std::move(doubt.text), true, doubt.verdict, std::move(doubt.trace)});
  }
  if (section.blocks.empty()) {
    section.blocks.emplace_back(Text{source.say("Nothing was refused and nothing looked doubtful."), false});
  }
  return section;
}

}  // namespace zerodrift::report
