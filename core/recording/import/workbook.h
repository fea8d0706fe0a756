#pragma once
// A sheet of an .xlsx workbook as cells (ECMA-376): values, shared strings, dates as ISO 8601; no formulas are
// computed. Sizes are limited, so that a small file cannot unfold into more than a computer holds.

#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/recording/import/text_table.h"

namespace zerodrift::recording {

/// By its first bytes: a zip archive.
bool is_workbook(std::string_view bytes);
/// An empty sheet: the first. wrong_format, file_too_large, bad_argument (no such sheet), workbook_formula (a formula
/// without its value).
Result<SourceCells> parse_workbook(std::string_view bytes, const std::string& file, const std::string& sheet = {});

}  // namespace zerodrift::recording
