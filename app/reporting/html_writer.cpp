#include <QString>
#include <set>

#include "app/reporting/drawing.h"
#include "app/reporting/plot_data.h"
#include "app/reporting/writers.h"
#include "core/base/file.h"
#include "core/report/find_figure.h"

namespace zerodrift::reporting {
namespace {

constexpr const char* style = R"(
body{font:14px/1.5 Inter,"Noto Sans CJK SC","Microsoft YaHei","Noto Sans",sans-serif;color:#1c2530;background:#f3f5f7;margin:0}
main{max-width:900px;margin:24px auto;background:#fff;border:1px solid #d9dfe5;border-radius:6px;padding:32px 40px}
h1{font-size:24px;margin:0 0 8px}h2{font-size:18px;margin:32px 0 8px;border-bottom:1px solid #d9dfe5;padding-bottom:4px}
h3{font-size:14px;margin:16px 0 4px}
.head{color:#5f6e7c;display:grid;grid-template-columns:max-content auto;gap:2px 16px}
.figures{display:flex;flex-wrap:wrap;gap:12px;margin:12px 0}
.figure{border:1px solid #d9dfe5;border-radius:6px;padding:8px 14px;min-width:130px}
.figure b{display:block;font-size:22px;font-weight:600;font-variant-numeric:tabular-nums}
.figure small{color:#5f6e7c}.good{border-left:4px solid #2e8b57}.doubtful{border-left:4px solid #c77700}.bad{border-left:4px solid #c4314b}
a.trace{color:inherit;text-decoration:none}a.trace:hover{text-decoration:underline}
table{border-collapse:collapse;width:100%;font-size:12px;font-variant-numeric:tabular-nums}
th,td{border-bottom:1px solid #d9dfe5;padding:3px 8px;text-align:left;overflow-wrap:anywhere}th{color:#5f6e7c;font-weight:600}
td.bad{border-left:0;color:#b3263f;font-weight:600}
.warning{border-left:4px solid #c77700;padding:4px 12px;background:#fff8ec}
.warning.worst{border-left-color:#c4314b;background:#fdf0f2}
.company{float:right;text-align:right;color:#5f6e7c;font-size:12px}.company img{max-width:200px;max-height:60px}
.half{display:inline-block;width:49%;vertical-align:top}
:target{background:#e3eefb}
nav{margin:16px 0}nav a{margin-right:14px}footer{color:#5f6e7c;font-size:11px;margin-top:32px}
svg{max-width:100%;height:auto}
@media print{body{background:#fff}main{border:0;margin:0;max-width:none}}
)";

/// Whatever was entered by a person or came from a file is text and never markup.
std::string escaped(const std::string& text) {
  return QString::fromStdString(text).toHtmlEscaped().replace(QLatin1Char('\''), QLatin1String("&#39;")).toStdString();
}

const char* class_of(report::Verdict verdict) {
  switch (verdict) {
    case report::Verdict::good:
      return "figure good";
    case report::Verdict::doubtful:
      return "figure doubtful";
    case report::Verdict::bad:
      return "figure bad";
    case report::Verdict::none:
      break;
  }
  return "figure";
}

std::string artefact_of(const report::Trace& trace) {
  return trace.artefact + " #" + std::to_string(trace.id);
}

/// The value as a link to the line that says where it comes from.
std::string linked(const std::string& id, const std::string& value, const report::Trace& trace) {
  return "<a class=\"trace\" href=\"#trace-" + escaped(id) + "\" title=\"" +
         escaped(artefact_of(trace) + ": " + trace.detail) + "\">" + escaped(value) + "</a>";
}

std::string heading(const std::string& title) {
  return title.empty() ? "" : "<h3>" + escaped(title) + "</h3>\n";
}

struct BlockHtml {
  std::string operator()(const report::Text& text) const {
    const bool worst = text.verdict == report::Verdict::bad;
    const char* opening = !text.warning ? "<p>" : worst ? "<p class=\"warning worst\">" : "<p class=\"warning\">";
    return opening + escaped(text.text) + "</p>\n";
  }

  std::string operator()(const report::Figures& figures) const {
    std::string out = "<div class=\"figures\">\n";
    for (const auto& f : figures.figures) {
      out += std::string("<div class=\"") + class_of(f.verdict) + "\" id=\"" + escaped(f.id) + "\"><small>" +
             escaped(f.label) + "</small><b>" + linked(f.id, f.value, f.trace) + " <small>" + escaped(f.unit) +
             "</small></b><small>" + escaped(f.limit) + "</small></div>\n";
    }
    return out + "</div>\n";
  }

  std::string operator()(const report::Table& table) const {
    // A section and its only table have the same id.
    std::string out = heading(table.title) + "<table id=\"table-" + escaped(table.id) + "\"><thead><tr>";
    for (const auto& cell : table.header) out += "<th>" + escaped(cell) + "</th>";
    out += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
      out += "<tr>";
      for (const auto& cell : row) {
        out += cell.verdict == report::Verdict::bad ? "<td class=\"bad\"" : "<td";
        if (!cell.id.empty()) out += " id=\"" + escaped(cell.id) + "\"";
        out += ">" + (cell.id.empty() ? escaped(cell.text) : linked(cell.id, cell.text, cell.trace)) + "</td>";
      }
      out += "</tr>\n";
    }
    return out + "</tbody></table>\n";
  }

  std::string operator()(const report::Plot& plot) const {
    const bool half = plot.width == report::Width::half;
    return std::string(half ? "<div class=\"half\">" : "<div>") + heading(plot.title) +
           ui::reportPlotSvg(plot_data(plot), half ? QSize(410, 210) : QSize(820, 300)).toStdString() + "</div>\n";
  }

  std::string operator()(const report::HeatMap& map) const {
    return heading(map.title) + ui::reportMapSvg(map_data(map), QSize(820, 300)).toStdString() + "\n";
  }
};

std::string rows_in_words(const report::Trace& trace) {
  std::string text;
  for (const auto& row : trace.rows) {
    text += (text.empty() ? "" : "; ") + QStringLiteral("series %1, row %2, %3 s, %4 = %5")
                                             .arg(row.series)
                                             .arg(row.row)
                                             .arg(row.time_s, 0, 'f', 3)
                                             .arg(QString::fromStdString(row.channel))
                                             .arg(row.value)
                                             .toStdString();
  }
  return text;
}

/// A line for each figure, so that its link has a target that says which artefact and which rows it came from.
std::string traces_of(const report::Report& report) {
  std::string rows;
  std::set<std::string> done;
  for (const auto& f : report::all_figures(report)) {
    if (!done.insert(f.id).second) continue;
    rows += "<tr id=\"trace-" + escaped(f.id) + "\"><td><a href=\"#" + escaped(f.id) + "\">" + escaped(f.id) +
            "</a></td><td>" + escaped(f.value + (f.unit.empty() ? "" : " " + f.unit)) + "</td><td>" +
            escaped(artefact_of(f.trace)) + "</td><td>" + escaped(f.trace.detail) + "</td><td>" +
            escaped(rows_in_words(f.trace)) + "</td></tr>\n";
  }
  const std::string heading = report.origins.empty() ? "Where each figure comes from" : report.origins;
  return "<h2 id=\"origins\">" + escaped(heading) + "</h2>\n<table><tbody>\n" + rows + "</tbody></table>\n";
}

class HtmlText {
 public:
  explicit HtmlText(const report::Report& report) : m_report(report) {}

  /// The next block; false when that was the last.
  bool step() {
    if (m_text.empty()) {
      head();
    } else if (m_section < m_report.sections.size()) {
      next_block();
    } else {
      foot();
      return false;
    }
    return true;
  }
  const std::string& text() const { return m_text; }

 private:
  void head() {
    std::string company;
    if (!m_report.logo_png.empty()) {
      const auto png = QByteArray::fromStdString(m_report.logo_png).toBase64().toStdString();
      company += "<img alt=\"logo\" src=\"data:image/png;base64," + png + "\"><br>";
    }
    for (const auto& line : m_report.company) company += escaped(line) + "<br>";
    if (!company.empty()) company = "<div class=\"company\">" + company + "</div>\n";
    m_text = "<!DOCTYPE html>\n<html lang=\"" + escaped(m_report.language) +
             "\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" content=\"width=device-width\"><title>" +
             escaped(m_report.title) + "</title><style>" + style + "</style></head><body><main>\n" + company + "<h1>" +
             escaped(m_report.title) + "</h1>\n<div class=\"head\">";
    for (const auto& [name, value] : m_report.header) {
      m_text += "<span>" + escaped(name) + "</span><span>" + escaped(value) + "</span>\n";
    }
    m_text += "</div>\n<nav>";
    for (const auto& section : m_report.sections) {
      m_text += "<a href=\"#" + escaped(section.id) + "\">" + escaped(section.title) + "</a>\n";
    }
    m_text += "</nav>\n";
  }
  void next_block() {
    const auto& section = m_report.sections[m_section];
    if (m_block == 0) m_text += "<h2 id=\"" + escaped(section.id) + "\">" + escaped(section.title) + "</h2>\n";
    if (m_block < section.blocks.size()) m_text += std::visit(BlockHtml{}, section.blocks[m_block]);
    if (++m_block < section.blocks.size()) return;
    m_block = 0;
    ++m_section;
  }
  void foot() {
    m_text += traces_of(m_report);
    if (!m_report.signature_png.empty()) {
      const auto png = QByteArray::fromStdString(m_report.signature_png).toBase64().toStdString();
      m_text += "<p><img alt=\"signature\" height=\"64\" src=\"data:image/png;base64," + png + "\"></p>\n";
    }
    m_text += "<footer>" + escaped(m_report.provenance) + "</footer></main></body></html>\n";
  }

  const report::Report& m_report;
  std::string m_text;
  std::size_t m_section = 0;
  std::size_t m_block = 0;
};

class HtmlDrawing : public Drawing {
 public:
  HtmlDrawing(report::Report report, std::filesystem::path path)
      : m_report(std::move(report)), m_path(std::move(path)), m_text(m_report) {}

  Result<bool> step() override {
    if (m_text.step()) return true;
    ZD_CHECK(write_file(m_path, m_text.text()));
    return false;
  }

 private:
  report::Report m_report;
  std::filesystem::path m_path;
  HtmlText m_text;
};

}  // namespace

std::string html_of(const report::Report& report) {
  HtmlText text(report);
  while (text.step()) {
  }
  return text.text();
}

std::unique_ptr<Drawing> html_drawing(report::Report report, const std::filesystem::path& path) {
  return std::make_unique<HtmlDrawing>(std::move(report), path);
}

}  // namespace zerodrift::reporting
