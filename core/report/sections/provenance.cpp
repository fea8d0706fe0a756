// Which artefact made the figures, by which program, and every write to the machine.

#include "core/report/provenance.h"

#include <fmt/format.h>

#include "core/commissioning/audit_words.h"
#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

std::string who(const Source& source, const std::string& engineer) {
  return engineer.empty() ? source.say("nobody named") : engineer;
}

Table artefacts_of(const Source& source) {
  Table table;
  table.id = "artefacts";
  table.title = source.say("Artefacts");
  table.header = {source.say("artefact"), source.say("made, UTC"), source.say("by"), source.say("who"), "SHA-256"};
  for (const auto& [kind, all] : source.artefacts()) {
    if (kind == "report") continue;  // an earlier report is no part of this one
    for (const auto& artefact : all) {
      table.rows.push_back({source.say(kind) + " #" + std::to_string(artefact.id), artefact.created_utc,
                            artefact.made_by, who(source, artefact.engineer), artefact.content_hash.substr(0, 16)});
    }
  }
  return table;
}

Table writes_of(const Source& source) {
  Table table;
  table.id = "writes";
  table.title = source.say("Writes to the machine");
  table.header = {
      "UTC", source.say("who"), source.say("what"), source.say("before"), source.say("after"), source.say("result")};
  for (const auto& entry : source.audit()) {
    table.rows.push_back({entry.utc, who(source, entry.engineer),
                          source.say(entry.action) + ": " + source.say(entry.subject), source.in_words(entry.old_value),
                          source.in_words(commissioning::value_in_short(entry.new_value)), source.say(entry.result)});
  }
  return table;
}

Table changes_of(const Source& source) {
  Table table;
  table.id = "header_changes";
  table.title = source.say("Changes of the job's head");
  table.header = {"UTC", source.say("who"), source.say("field"), source.say("from"), source.say("to")};
  for (const auto& change : source.header_changes()) {
    table.rows.push_back(
        {change.utc, who(source, change.engineer), source.say(change.key), change.old_value, change.new_value});
  }
  return table;
}

}  // namespace

std::string job_hash(const Source& source) {
  std::string text;
  for (const auto& [kind, all] : source.artefacts()) {
    if (kind == "report") continue;
    for (const auto& artefact : all) text += fmt::format("{} {} {}\n", kind, artefact.id, artefact.content_hash);
  }
  if (!source.audit().empty()) text += source.audit().back().hash;
  return sha256_hex(text);
}

std::optional<Section> provenance_section(const Source& source) {
  Section section{"provenance", source.say("Provenance"), {}};
  section.blocks.emplace_back(
      Text{source.tell("Job begun {} UTC; SHA-256 over all its results and writes: {}. Report by Zerodrift {}.",
                       minute_of(source.created_utc()), job_hash(source), ZERODRIFT_VERSION),
           false});
  if (!source.audit_is_whole()) {
    section.blocks.emplace_back(
        Text{source.say("The record of writes to the machine was changed afterwards."), true, Verdict::bad});
  }
  section.blocks.emplace_back(artefacts_of(source));
  if (auto writes = writes_of(source); !writes.rows.empty()) section.blocks.emplace_back(std::move(writes));
  if (source.audit_is_whole() && !source.audit().empty()) {
    // Printed, the last hash binds the whole trail to this paper: whoever rewrites the job changes it.
    section.blocks.emplace_back(Text{source.tell("Record of writes verified: {} entries, the last with SHA-256 {}.",
                                                 source.audit().size(), source.audit().back().hash.substr(0, 16)),
                                     false});
  }
  if (auto changes = changes_of(source); !changes.rows.empty()) section.blocks.emplace_back(std::move(changes));
  return section;
}

}  // namespace zerodrift::report
