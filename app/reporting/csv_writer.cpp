#include "app/reporting/writers.h"
#include "core/base/file.h"
#include "core/recording/csv.h"
#include "core/report/find_figure.h"

namespace zerodrift::reporting {
namespace {

using recording::cell_text;

const char* word_of(report::Verdict verdict) {
  switch (verdict) {
    case report::Verdict::none:
      return "";
    case report::Verdict::good:
      return "good";
    case report::Verdict::doubtful:
      return "doubtful";
    case report::Verdict::bad:
      return "bad";
  }
  return "";
}

}  // namespace

std::string csv_of(const report::Report& report) {
  std::string out = "section,figure,label,value,unit,limit,verdict,artefact,detail\n";
  for (const auto& [name, value] : report.header)
    out += "head,," + cell_text(name) + "," + cell_text(value) + ",,,,,\n";
  for (const auto& section : report.sections) {
    report::Report one;
    one.sections = {section};
    for (const auto& f : report::all_figures(one)) {
      const std::string artefact = f.trace.artefact + "#" + std::to_string(f.trace.id);
      for (const auto& cell : {section.id, f.id, f.label, f.value, f.unit, f.limit}) out += cell_text(cell) + ",";
      out += std::string(word_of(f.verdict)) + "," + cell_text(artefact) + "," + cell_text(f.trace.detail) + "\n";
    }
    for (const auto& block : section.blocks) {
      const auto* text = std::get_if<report::Text>(&block);
      if (text == nullptr || !text->warning) continue;
      out += section.id + ",," + cell_text(text->text) + ",,,," + word_of(text->verdict) + "," +
             cell_text(text->trace.artefact) + "," + cell_text(text->trace.detail) + "\n";
    }
  }
  return out;
}

Status write_report(const report::Report& report, const std::filesystem::path& path) {
  const auto extension = path.extension();
  if (extension == ".pdf") return write_pdf(report, path);
  if (extension == ".html" || extension == ".htm") return write_file(path, html_of(report));
  if (extension == ".csv") return write_file(path, csv_of(report));
  return fail(ErrorCode::wrong_format, {{"file", path.string()},
                                        {"found", "a name ending in \"" + extension.string() + "\""},
                                        {"expected", ".pdf, .html or .csv"}});
}

}  // namespace zerodrift::reporting
