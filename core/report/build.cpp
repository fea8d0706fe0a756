#include "core/report/build.h"

#include <array>

#include "core/report/provenance.h"

namespace zerodrift::report {

Result<Report> build_report(const commissioning::Job& job, Language language) {
  ZD_TRY(const Source source, Source::load(job, words_of(language)));
  Report report;
  report.language = code_of(language);
  const auto& header = source.header();
  report.title = source.say("Thermal compensation report");
  const auto line = [&](const char* name, const std::string& value) {
    if (!value.empty()) report.header.emplace_back(source.say(name), value);
  };
  line("Customer", header.customer);
  line("Machine", header.machine.empty() ? source.say("not named") : header.machine);
  line("Serial number", header.serial.empty() ? source.say("not named") : header.serial);
  // Who answers for a report is never left open in silence.
  line("Engineer", header.engineer.empty() ? source.say("not named") : header.engineer);
  const LoadedArtefact* last = source.find("verification");
  if (last == nullptr) last = source.find("warmup");
  report.made_utc = last == nullptr ? job.created_utc() : last->created_utc;
  line("Date", minute_of(report.made_utc) + " UTC");
  line("Notes", header.notes);
  // What is doubtful comes before what rests on it.
  constexpr std::array sections = {summary_section,      doubts_section,   setup_section,     uncertainty_section,
                                   warmup_section,       iso230_3_section, sensors_section,   choice_section,
                                   model_section,        physics_section,  table_section,     upload_section,
                                   verification_section, axis_section,     provenance_section};
  for (const auto section : sections) {
    if (auto made = section(source)) report.sections.push_back(std::move(*made));
  }
  report.contents = source.say("Contents");
  report.origins = source.say("Where each figure comes from");
  report.provenance = source.tell("Zerodrift {}, job {}", ZERODRIFT_VERSION, job_hash(source).substr(0, 16));
  return report;
}

}  // namespace zerodrift::report
