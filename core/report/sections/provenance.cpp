// Which artefact made the figures, by which program, and every write to the machine.

#include "core/report/build.h"

namespace zerodrift::report {

std::optional<Section> provenance_section(const Source& source) {
  Section section{"provenance", source.say("Provenance"), {}};
  Table artefacts;
  artefacts.id = "artefacts";
  artefacts.title = source.say("Artefacts");
  artefacts.header = {source.say("artefact"), source.say("made, UTC"), source.say("by"), "SHA-256"};
  for (const auto& [kind, artefact] : source.artefacts()) {
    artefacts.rows.push_back({kind + " #" + std::to_string(artefact.id), artefact.created_utc, artefact.made_by,
                              artefact.content_hash.substr(0, 16)});
  }
  section.blocks.emplace_back(std::move(artefacts));
  Table writes;
  writes.id = "writes";
  writes.title = source.say("Writes to the machine");
  writes.header = {source.say("UTC"), source.say("who"), source.say("what"), source.say("result")};
  for (const auto& entry : source.audit()) {
    writes.rows.push_back({entry.utc, entry.engineer, entry.action + " " + entry.subject, entry.result});
  }
  if (!writes.rows.empty()) section.blocks.emplace_back(std::move(writes));
  return section;
}

}  // namespace zerodrift::report
