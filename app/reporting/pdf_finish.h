#pragma once
// What Qt's PDF writer does not put into a document: links of the contents, bookmarks, the language, and a date and an
// identifier that are the same each time, so that the same report gives the same bytes.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "app/reporting/paper.h"
#include "core/base/result.h"

namespace zerodrift::reporting {

struct PdfMarks {
  std::vector<PaperOutline> outline;
  std::vector<PaperLink> links;
  std::string language;
  std::string made_utc;  // ISO 8601
};

/// `path` is for messages.
Result<std::string> finished_pdf(std::string_view pdf, const PdfMarks& marks, const std::filesystem::path& path);

}  // namespace zerodrift::reporting
