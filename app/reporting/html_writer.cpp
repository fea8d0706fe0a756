#include <QString>

#include "app/reporting/plot_data.h"
#include "app/reporting/writers.h"

namespace zerodrift::reporting {
namespace {

constexpr const char* style = R"(
body{font:14px/1.5 Inter,"Noto Sans CJK SC","Noto Sans",sans-serif;color:#1c2530;background:#f3f5f7;margin:0}
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
th,td{border-bottom:1px solid #d9dfe5;padding:3px 8px;text-align:left}th{color:#5f6e7c;font-weight:600}
.warning{border-left:4px solid #c77700;padding:4px 12px;background:#fff8ec}
.warning.worst{border-left-color:#c4314b;background:#fdf0f2}
nav{margin:16px 0}nav a{margin-right:14px}footer{color:#5f6e7c;font-size:11px;margin-top:32px}
svg{max-width:100%;height:auto}
)";

std::string escaped(const std::string& text) {
  return QString::fromStdString(text).toHtmlEscaped().toStdString();
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

std::string trace_anchor(const report::Trace& trace) {
  return trace.artefact + "-" + std::to_string(trace.id);
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
             escaped(f.label) + "</small><b><a class=\"trace\" href=\"#trace-" + escaped(trace_anchor(f.trace)) +
             "\" title=\"" + escaped(f.trace.artefact + " #" + std::to_string(f.trace.id) + ": " + f.trace.detail) +
             "\">" + escaped(f.value) + "</a> <small>" + escaped(f.unit) + "</small></b><small>" + escaped(f.limit) +
             "</small></div>\n";
    }
    return out + "</div>\n";
  }

  std::string operator()(const report::Table& table) const {
    std::string out = "<h3>" + escaped(table.title) + "</h3>\n<table><thead><tr>";
    for (const auto& cell : table.header) out += "<th>" + escaped(cell) + "</th>";
    out += "</tr></thead><tbody>\n";
    for (const auto& row : table.rows) {
      out += "<tr>";
      for (const auto& cell : row) out += "<td>" + escaped(cell) + "</td>";
      out += "</tr>\n";
    }
    return out + "</tbody></table>\n";
  }

  std::string operator()(const report::Plot& plot) const {
    return "<h3>" + escaped(plot.title) + "</h3>\n" +
           ui::reportPlotSvg(plot_data(plot), QSize(820, 300)).toStdString() + "\n";
  }
};

/// The artefacts behind the figures, so that each number's link has a target that says where it came from.
std::string traces_of(const report::Report& report) {
  std::string rows;
  std::string last;
  for (const auto& section : report.sections) {
    for (const auto& block : section.blocks) {
      const auto* figures = std::get_if<report::Figures>(&block);
      if (figures == nullptr) continue;
      for (const auto& f : figures->figures) {
        const std::string anchor = trace_anchor(f.trace);
        rows += "<tr" + (anchor == last ? "" : " id=\"trace-" + escaped(anchor) + "\"") + "><td><a href=\"#" +
                escaped(f.id) + "\">" + escaped(f.id) + "</a></td><td>" + escaped(f.trace.artefact) + " #" +
                std::to_string(f.trace.id) + "</td><td>" + escaped(f.trace.detail) + "</td></tr>\n";
        last = anchor;
      }
    }
  }
  return "<h2>Where each figure comes from</h2>\n<table><tbody>\n" + rows + "</tbody></table>\n";
}

}  // namespace

std::string html_of(const report::Report& report) {
  std::string out = "<!DOCTYPE html>\n<html><head><meta charset=\"utf-8\"><title>" + escaped(report.title) +
                    "</title><style>" + style + "</style></head><body><main>\n<h1>" + escaped(report.title) +
                    "</h1>\n<div class=\"head\">";
  for (const auto& [name, value] : report.header) {
    out += "<span>" + escaped(name) + "</span><span>" + escaped(value) + "</span>\n";
  }
  out += "</div>\n<nav>";
  for (const auto& section : report.sections) {
    out += "<a href=\"#" + escaped(section.id) + "\">" + escaped(section.title) + "</a>";
  }
  out += "</nav>\n";
  for (const auto& section : report.sections) {
    out += "<h2 id=\"" + escaped(section.id) + "\">" + escaped(section.title) + "</h2>\n";
    for (const auto& block : section.blocks) out += std::visit(BlockHtml{}, block);
  }
  out += traces_of(report);
  if (!report.signature_png.empty()) {
    const auto png = QByteArray::fromStdString(report.signature_png).toBase64().toStdString();
    out += "<p><img alt=\"signature\" height=\"64\" src=\"data:image/png;base64," + png + "\"></p>\n";
  }
  return out + "<footer>" + escaped(report.provenance) + "</footer></main></body></html>\n";
}

}  // namespace zerodrift::reporting
