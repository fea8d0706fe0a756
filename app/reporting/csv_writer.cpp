#include "app/reporting/drawing.h"
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

namespace {

class CsvDrawing : public Drawing {
 public:
  CsvDrawing(report::Report report, std::filesystem::path path)
      : m_report(std::move(report)), m_path(std::move(path)) {}

  Result<bool> step() override {
    ZD_CHECK(write_file(m_path, csv_of(m_report)));
    return false;
  }

 private:
  report::Report m_report;
  std::filesystem::path m_path;
};

}  // namespace

Result<std::unique_ptr<Drawing>> drawing_of(report::Report report, const std::filesystem::path& path) {
  const auto extension = path.extension();
  if (extension == ".pdf") return pdf_drawing(std::move(report), path);
  if (extension == ".html" || extension == ".htm") return html_drawing(std::move(report), path);
  if (extension == ".csv") return std::unique_ptr<Drawing>(std::make_unique<CsvDrawing>(std::move(report), path));
  return fail(ErrorCode::wrong_format, {{"file", path.string()},
                                        {"found", "a name ending in \"" + extension.string() + "\""},
                                        {"expected", ".pdf, .html or .csv"}});
}

Status draw(Drawing& drawing) {
  for (;;) {
    ZD_TRY(const bool more, drawing.step());
    if (!more) return {};
  }
}

Status write_report(const report::Report& report, const std::filesystem::path& path) {
  ZD_TRY(const auto drawing, drawing_of(report, path));
  return draw(*drawing);
}

}  // namespace zerodrift::reporting
