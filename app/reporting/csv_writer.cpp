#include "app/reporting/writers.h"
#include "core/base/file.h"
#include "core/recording/csv.h"

namespace zerodrift::reporting {
namespace {

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

/// A cell that no spreadsheet takes for a formula.
std::string harmless(const std::string& text) {
  const bool number = !text.empty() && text.find_first_not_of("+-.0123456789eE") == std::string::npos;
  const bool formula = !text.empty() && !number && std::string_view("=+-@\t").find(text[0]) != std::string_view::npos;
  return recording::cell_text(formula ? "'" + text : text);
}

}  // namespace

std::string csv_of(const report::Report& report) {
  std::string out = "section,figure,label,value,unit,limit,verdict,artefact,detail\n";
  for (const auto& section : report.sections) {
    for (const auto& block : section.blocks) {
      const auto* figures = std::get_if<report::Figures>(&block);
      if (figures == nullptr) continue;
      for (const auto& f : figures->figures) {
        const std::string artefact = f.trace.artefact + "#" + std::to_string(f.trace.id);
        for (const auto& cell : {section.id, f.id, f.label, f.value, f.unit, f.limit}) out += harmless(cell) + ",";
        out += std::string(word_of(f.verdict)) + "," + harmless(artefact) + "," + harmless(f.trace.detail) + "\n";
      }
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
