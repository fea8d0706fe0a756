#include "core/recording/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/base/json.h"
#include "core/recording/import/cell_words.h"
#include "core/recording/import/cells.h"
#include "core/recording/import/importer.h"
#include "core/recording/import/text_table.h"

namespace zerodrift::recording {
namespace {

/// Other bytes, as an old file's name has them, are told by the replacement character: the whole file would be no
/// UTF-8.
std::string in_utf8(std::string text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  return plain ? text : nlohmann::json::parse(json_text(text)).get<std::string>();
}

}  // namespace

int TextTable::column(std::string_view name) const {
  const auto at = std::find(header.begin(), header.end(), name);
  return at == header.end() ? -1 : static_cast<int>(at - header.begin());
}

Result<TextTable> parse_table(std::string_view text, const std::string& file) {
  ZD_TRY(const SourceCells source, parse_cells(text, file));
  TextTable table;
  table.file = file;
  for (std::size_t row = 0; row < source.cells.rows(); ++row) {
    if (source.cells.is_comment(row) || source.cells.is_blank(row)) continue;
    auto cells = source.cells.row(row);
    if (table.header.empty()) {
      table.header = std::move(cells);
      ZD_TRY(table.numbers, number_format_of(source.cells, row + 1, file));
      continue;
    }
    if (cells.size() != table.header.size()) {
      return fail(ErrorCode::csv_cell_count, {{"file", file},
                                              {"line", std::to_string(source.cells.line(row))},
                                              {"found", std::to_string(cells.size())},
                                              {"expected", std::to_string(table.header.size())}});
    }
    table.rows.push_back(std::move(cells));
    table.lines.push_back(source.cells.line(row));
  }
  if (table.header.empty() || table.rows.empty()) return fail(ErrorCode::csv_empty, {{"file", file}});
  return table;
}

Result<TextTable> read_table(const std::filesystem::path& path) {
  ZD_TRY(const std::string text, read_file(path));
  return parse_table(text, path.string());
}

Result<double> number_in(const TextTable& table, std::size_t row, int column) {
  const std::string& cell = table.rows[row][static_cast<std::size_t>(column)];
  if (means_missing(cell)) return std::numeric_limits<double>::quiet_NaN();
  if (const auto value = table.numbers.number(cell)) return *value;
  return fail(ErrorCode::csv_bad_number, {{"file", table.file},
                                          {"line", std::to_string(table.lines[row])},
                                          {"column", table.header[static_cast<std::size_t>(column)]},
                                          {"found", cell}});
}

Result<Recording> parse_recording(std::string_view text, const std::string& file, const HeaderMap& map) {
  ZD_TRY(Imported imported, import_recording(text, file, map));
  return std::move(imported.recording);
}

Result<Recording> read_recording(const std::filesystem::path& path, const HeaderMap& map) {
  ZD_TRY(Imported imported, import_file(path, map));
  return std::move(imported.recording);
}

std::string number_text(double value) {
  return std::isnan(value) ? std::string() : fmt::format("{}", value);
}

std::string cell_text(std::string_view entered) {
  std::string text = in_utf8((is_formula(entered) ? "'" : "") + std::string(entered));
  // Blanks at its ends belong to a quoted cell only.
  if (text.find_first_of(",;\t\"\r\n") == std::string_view::npos && trimmed(text) == text) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string to_csv(const Recording& recording) {
  std::string out = "time_s";
  for (const auto& c : recording.channels) out += "," + cell_text(c.name);
  out += '\n';
  for (std::size_t r = 0; r < recording.rows(); ++r) {
    out += number_text(recording.time_s[r]);
    for (const auto& c : recording.channels) out += "," + number_text(c.values[r]);
    out += '\n';
  }
  return out;
}

Status write_recording(const std::filesystem::path& path, const Recording& recording) {
  return write_file(path, to_csv(recording));
}

}  // namespace zerodrift::recording
