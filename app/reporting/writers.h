#pragma once
// The report on paper (PDF), on screen (HTML, one file, no network) and for spreadsheets (CSV).
// PDF and HTML need a QApplication, on the offscreen platform if there is no display. All writes are atomic.

#include <filesystem>
#include <string>

#include "core/base/result.h"
#include "core/report/report.h"

namespace zerodrift::reporting {

Status write_pdf(const report::Report& report, const std::filesystem::path& path);
std::string html_of(const report::Report& report);
/// Figures as rows: section, figure, value, unit, limit, verdict, where it came from.
std::string csv_of(const report::Report& report);
/// By the file's extension, as drawing_of() does, all at once.
Status write_report(const report::Report& report, const std::filesystem::path& path);

}  // namespace zerodrift::reporting
