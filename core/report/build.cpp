#include "core/report/build.h"

#include <array>

namespace zerodrift::report {

/// "2026-11-21 07:28 UTC" of "2026-11-21T07:28:29.437Z".
static std::string minute_of(const std::string& utc) {
  constexpr std::size_t minutes = 16;
  if (utc.size() < minutes || utc[10] != 'T') return utc;
  return utc.substr(0, 10) + " " + utc.substr(11, 5) + " UTC";
}

Result<Report> build_report(const commissioning::Job& job, const Words& words) {
  ZD_TRY(const Source source, Source::load(job, words));
  Report report;
  const auto& header = source.header();
  report.title = source.say("Thermal compensation report");
  const auto line = [&](const char* name, const std::string& value) {
    if (!value.empty()) report.header.emplace_back(source.say(name), value);
  };
  line("Machine", header.machine);
  line("Serial number", header.serial);
  line("Customer", header.customer);
  line("Engineer", header.engineer);
  const LoadedArtefact* last = source.find("verification");
  if (last == nullptr) last = source.find("warmup");
  line("Date", minute_of(last == nullptr ? job.created_utc() : last->created_utc));
  line("Notes", header.notes);
  // What is doubtful comes before what rests on it.
  constexpr std::array sections = {summary_section,      doubts_section,    setup_section,   warmup_section,
                                   sensors_section,      model_section,     physics_section, upload_section,
                                   verification_section, provenance_section};
  for (const auto section : sections) {
    if (auto made = section(source)) report.sections.push_back(std::move(*made));
  }
  report.provenance = "Zerodrift " ZERODRIFT_VERSION;
  if (last != nullptr) report.provenance += ", " + last->content_hash.substr(0, 16);
  return report;
}

}  // namespace zerodrift::report
