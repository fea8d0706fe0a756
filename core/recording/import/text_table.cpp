#include "core/recording/import/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "core/base/file.h"
#include "core/recording/import/cell_words.h"
#include "core/recording/import/clock_text.h"
#include "core/recording/import/text_decoding.h"
#include "core/recording/import/units.h"
#include "core/recording/import/workbook.h"

namespace zerodrift::recording {
namespace {

constexpr std::size_t sample_rows = 2000;  // from the end of a file, to learn what its rows are like
constexpr std::size_t widest_header = 4;   // rows: names, units, and what TOA5 and its kin write beside them

bool is_measured(std::string_view cell) {
  return looks_like_number(cell) || read_clock_text(cell).has_value();
}

std::string lowered_ascii(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

std::size_t filled_width(const Cells& cells, std::size_t row) {
  std::size_t width = cells.columns(row);
  while (width > 0 && cells.at(row, width - 1).empty()) --width;
  return width;
}

/// What the rows of the table are like, learned from the end of the file.
struct Shape {
  std::size_t width = 0;           // columns that hold something
  std::size_t key = 0;             // the first column with a number or a time in nearly each row
  std::vector<bool> holds_values;  // columns of numbers, times, switches
};

struct ColumnCounts {
  std::size_t filled = 0;
  std::size_t values = 0;
  std::size_t measured = 0;
};

/// Rows with a number or a time, and so large a share of values, from the end of the file upwards.
std::vector<std::size_t> rows_with_values(const Cells& cells, double share) {
  std::vector<std::size_t> rows;
  for (std::size_t row = cells.rows(); row-- > 0 && rows.size() < sample_rows;) {
    if (cells.is_comment(row)) continue;
    std::size_t filled = 0;
    std::size_t values = 0;
    bool measured = false;
    for (std::size_t column = 0; column < cells.columns(row); ++column) {
      const std::string_view cell = cells.at(row, column);
      filled += !cell.empty();
      values += is_value(cell);
      measured = measured || is_measured(cell);
    }
    if (measured && static_cast<double>(values) >= share * static_cast<double>(filled)) rows.push_back(row);
  }
  return rows;
}

std::optional<Shape> shape_of(const Cells& cells) {
  std::vector<std::size_t> rows = rows_with_values(cells, 0.6);  // a setting and its number, as in a block, have 0.5
  if (rows.empty()) rows = rows_with_values(cells, 0.3);
  if (rows.size() > 1 && rows.size() < sample_rows) rows.pop_back();  // the uppermost may be a header of numbers
  std::map<std::size_t, std::size_t> widths;
  for (const std::size_t row : rows) ++widths[cells.columns(row)];
  if (widths.empty()) return std::nullopt;
  const auto most = std::max_element(widths.begin(), widths.end(),
                                     [](const auto& a, const auto& b) { return a.second <= b.second && a != b; });
  std::vector<ColumnCounts> columns(most->first);
  std::size_t count = 0;
  Shape shape;
  for (const std::size_t row : rows) {
    if (cells.columns(row) != most->first) continue;
    ++count;
    shape.width = std::max(shape.width, filled_width(cells, row));
    for (std::size_t column = 0; column < columns.size(); ++column) {
      const std::string_view cell = cells.at(row, column);
      if (cell.empty()) continue;
      ++columns[column].filled;
      columns[column].values += is_value(cell);
      columns[column].measured += is_measured(cell);
    }
  }
  double best = -1.0;
  for (std::size_t column = 0; column < columns.size(); ++column) {
    const auto& c = columns[column];
    shape.holds_values.push_back(c.filled > 0 && 10 * c.values >= 9 * c.filled);
    const double share = static_cast<double>(c.measured) / static_cast<double>(count);
    if (share > best && best < 0.9) {
      best = share;
      shape.key = column;
    }
  }
  return shape;
}

/// Words where the table has values: names, units or a group's title.
bool is_header_like(const Cells& cells, std::size_t row, const Shape& shape) {
  if (is_measured(cells.at(row, shape.key))) return false;
  std::size_t filled = 0;
  std::size_t words = 0;
  for (std::size_t column = 0; column < cells.columns(row); ++column) {
    const std::string_view cell = cells.at(row, column);
    filled += !cell.empty();
    words += !cell.empty() && !is_value(cell);
  }
  return 5 * filled >= 3 * shape.width && 2 * words > filled;
}

std::size_t unit_words(const Cells& cells, std::size_t row) {
  std::size_t count = 0;
  for (std::size_t column = 0; column < cells.columns(row); ++column) count += is_unit_word(cells.at(row, column));
  return count;
}

struct Header {
  std::optional<std::size_t> names;
  std::optional<std::size_t> units;
  std::size_t body = 0;  // the first row after it
};

/// The last header-like row, the first of those that are alike: some loggers write their header again and again.
std::optional<std::size_t> last_header_row(const Cells& cells, const Shape& shape) {
  std::map<std::vector<std::string>, std::size_t> first;
  std::optional<std::size_t> last;
  for (std::size_t row = 0; row < cells.rows(); ++row) {
    if (cells.is_comment(row) || !is_header_like(cells, row, shape)) continue;
    const auto [at, is_new] = first.try_emplace(cells.row(row), row);
    if (is_new || !last) last = at->second;
  }
  return last;
}

/// A header whose names are numbers but for the first: "Time,101,102,103", right above the first row of the table.
std::optional<std::size_t> plain_header_row(const Cells& cells, const Shape& shape, std::size_t from) {
  std::optional<std::size_t> above;
  for (std::size_t row = from; row < cells.rows(); ++row) {
    if (cells.is_comment(row) || cells.is_blank(row)) continue;
    if (is_measured(cells.at(row, shape.key))) return above;
    const std::string_view key = cells.at(row, shape.key);
    std::size_t filled = 0;
    for (std::size_t column = 0; column < cells.columns(row); ++column) filled += !cells.at(row, column).empty();
    const bool wide = filled > 1 && 5 * filled >= 3 * shape.width;
    above = wide && !key.empty() && !is_value(key) ? std::optional(row) : std::nullopt;
  }
  return std::nullopt;
}

bool holds_words_only(const Cells& cells, std::size_t row) {
  std::size_t filled = 0;
  for (std::size_t column = 0; column < cells.columns(row); ++column) {
    const std::string_view cell = cells.at(row, column);
    if (is_value(cell)) return false;
    filled += !cell.empty();
  }
  return filled > 0;
}

/// Names and units out of header-like rows that follow each other.
Header header_of(const Cells& cells, const Shape& shape) {
  Header header;
  const auto last = last_header_row(cells, shape);
  if (const auto plain = plain_header_row(cells, shape, last ? *last + 1 : 0)) {
    header.names = *plain;
    header.body = *plain + 1;
    return header;
  }
  if (!last) return header;
  std::vector<std::size_t> group{*last};
  for (std::size_t row = *last; row-- > 0 && group.size() < widest_header;) {
    if (cells.is_comment(row) || cells.is_blank(row)) continue;
    if (!is_header_like(cells, row, shape)) break;
    group.insert(group.begin(), row);
  }
  header.body = *last + 1;
  header.names = *last;
  for (std::size_t row = header.body; row < cells.rows(); ++row) {  // units of some columns, "Avg" beside others
    if (cells.is_comment(row) || cells.is_blank(row)) continue;
    if (!holds_words_only(cells, row)) break;
    group.push_back(row);
    header.body = row + 1;
  }
  if (group.size() == 1) return header;
  std::size_t units = 0;
  for (std::size_t i = 1; i < group.size(); ++i) {
    if (unit_words(cells, group[i]) > unit_words(cells, group[units])) units = i;
  }
  const std::size_t count = unit_words(cells, group[units]);
  if (count == 0) return header;
  header.units = group[units];
  header.names = units > 0 ? group[units - 1] : group[1];
  return header;
}

/// The last remark before the first row, without its sign, where it names the columns: "# time_s T1_C T2_C".
std::vector<std::string> names_in_remark(const Cells& cells, const Shape& shape, char separator) {
  std::optional<std::size_t> remark;
  for (std::size_t row = 0; row < cells.rows(); ++row) {
    if (cells.is_comment(row)) {
      remark = row;
    } else if (is_measured(cells.at(row, shape.key))) {
      break;
    }
  }
  if (!remark) return {};
  std::string_view text = cells.at(*remark, 0);
  text.remove_prefix(std::min(text.find_first_not_of("#%/ "), text.size()));
  const auto split = split_cells(text, separator, {});
  if (!split || split->rows() != 1 || filled_width(*split, 0) != shape.width) return {};
  auto names = split->row(0);
  names.resize(shape.width);
  const bool any_number = std::any_of(names.begin(), names.end(), [](const auto& name) { return is_measured(name); });
  return any_number ? std::vector<std::string>{} : names;
}

/// A row of the block that says of itself that it holds units: "Y_Unit_Label" of LabVIEW, "Unit", "Einheit".
std::optional<std::size_t> labelled_units(const Cells& cells, std::size_t block_end, const Shape& shape) {
  std::optional<std::size_t> found;
  for (std::size_t row = 0; row < block_end; ++row) {
    const std::string label = lowered_ascii(cells.at(row, 0));
    const bool is_label = label == "y_unit_label" || label == "unit" || label == "units" || label == "einheit" ||
                          label == "einheiten" || label == "单位";
    if (is_label && filled_width(cells, row) + 1 >= shape.width) found = row;
  }
  return found;
}

/// "Decimal_Separator" of LabVIEW.
std::string labelled_decimal(const Cells& cells, std::size_t block_end) {
  for (std::size_t row = 0; row < block_end; ++row) {
    if (lowered_ascii(cells.at(row, 0)) == "decimal_separator") return std::string(cells.at(row, 1));
  }
  return {};
}

/// A column for words: a cell that a row lacks there can change no number.
bool is_for_words(std::string_view name) {
  const std::string lower = lowered_ascii(name);
  return lower.empty() || lower == "comment" || lower == "comments" || lower == "remark" || lower == "remarks" ||
         lower == "note" || lower == "notes" || lower == "event" || lower == "bemerkung" || lower == "kommentar" ||
         lower == "备注";
}

Status check_width(const SourceTable& table, std::size_t row, std::size_t named) {
  const std::size_t found = table.cells.columns(row);
  const bool too_wide = filled_width(table.cells, row) > named;
  bool too_short = false;
  for (std::size_t column = found; column < named; ++column)
    too_short = too_short || !is_for_words(table.names[column]);
  if (!too_wide && !too_short) return {};
  return fail(ErrorCode::csv_cell_count, {{"file", table.form.file},
                                          {"line", std::to_string(table.cells.line(row))},
                                          {"found", std::to_string(found)},
                                          {"expected", std::to_string(named)}});
}

tl::unexpected<Error> two_tables(const SourceTable& table, std::size_t one, std::size_t other) {
  return fail(ErrorCode::two_tables, {{"file", table.form.file},
                                      {"line", std::to_string(table.cells.line(one))},
                                      {"other_line", std::to_string(table.cells.line(other))}});
}

/// A row as wide as the table, or three, of numbers before the header: the file holds a table before this one.
Status check_single(const SourceTable& table, std::size_t header_row, std::size_t width) {
  std::size_t in_a_row = 0;
  for (std::size_t row = 0; row < header_row; ++row) {
    if (table.cells.is_comment(row) || table.cells.is_blank(row)) continue;
    std::size_t filled = 0;
    std::size_t values = 0;
    for (std::size_t column = 0; column < table.cells.columns(row); ++column) {
      filled += !table.cells.at(row, column).empty();
      values += is_value(table.cells.at(row, column));
    }
    in_a_row = filled > 1 && values == filled ? in_a_row + 1 : 0;
    if (in_a_row == 3 || (in_a_row > 0 && filled == width)) return two_tables(table, row, header_row);
  }
  return {};
}

Error remark(ErrorCode code, const SourceTable& table, std::size_t row) {
  return {code,
          {{"file", table.form.file},
           {"line", std::to_string(table.cells.line(row))},
           {"found", shortened(std::string(table.cells.at(row, 0)))}}};
}

Status collect_body(SourceTable& table, const Header& header, const Shape& shape) {
  const std::size_t named = table.names.size();
  std::set<std::vector<std::string>> before;  // rows that may come again with the header
  for (std::size_t row = 0; row < header.body; ++row) before.insert(table.cells.row(row));
  bool started = header.names.has_value();
  for (std::size_t row = header.body; row < table.cells.rows(); ++row) {
    if (table.cells.is_comment(row) || table.cells.is_blank(row)) continue;
    const bool measured = is_measured(table.cells.at(row, shape.key));
    if (!started && !measured) {  // a block before a table without header
      table.block_end = row + 1;
      continue;
    }
    started = true;
    if (header.names && !measured) {
      const bool repeated = before.contains(table.cells.row(row));
      std::size_t filled = 0;
      std::string_view only;
      for (std::size_t column = 0; column < table.cells.columns(row); ++column) {
        if (table.cells.at(row, column).empty()) continue;
        ++filled;
        only = table.cells.at(row, column);
      }
      const bool remark_alone = filled == 1 && !is_value(only) && named > 1;
      if (!repeated && !remark_alone && is_header_like(table.cells, row, shape)) {
        return two_tables(table, *header.names, row);
      }
      if (repeated || remark_alone) {
        table.remarks.push_back(
            remark(repeated ? ErrorCode::header_repeated : ErrorCode::line_passed_over, table, row));
        continue;
      }
    }
    ZD_CHECK(check_width(table, row, named));
    table.rows.push_back(row);
  }
  return {};
}

char separator_from(const std::string& name) {
  if (name == "tab") return '\t';
  if (name == "blanks") return separated_by_blanks;
  return name.front();
}

/// "sep=;" in the first line, which Excel obeys; takes the line away.
std::optional<char> declared_separator(std::string_view& text, int& line) {
  const std::size_t end = std::min(text.find_first_of("\r\n"), text.size());
  std::string first = lowered_ascii(trimmed(text.substr(0, end)));
  std::erase(first, '"');
  if (trimmed(text.substr(0, end)).size() < 4 || !first.starts_with("sep=")) {
    if (!text.substr(0, end).starts_with("sep=\t")) return std::nullopt;
  }
  const std::size_t at = lowered_ascii(text.substr(0, end)).find("sep=") + 4;
  if (at >= end) return std::nullopt;
  const char separator = text[at];
  text.remove_prefix(end);
  text.remove_prefix(text.starts_with("\r\n") ? 2 : text.empty() ? 0 : 1);
  ++line;
  return separator;
}

}  // namespace

int SourceTable::column(std::string_view name) const {
  const auto at = std::find(names.begin(), names.end(), name);
  return at == names.end() ? -1 : static_cast<int>(at - names.begin());
}

std::string SourceTable::name_of(std::size_t column) const {
  return names[column].empty() ? "#" + std::to_string(column + 1) : names[column];
}

Result<double> SourceTable::number(std::size_t row, std::size_t column) const {
  const std::string_view text = cell(row, column);
  if (means_missing(text)) return std::numeric_limits<double>::quiet_NaN();
  if (const auto value = form.numbers.number(text)) return *value;
  return fail(ErrorCode::csv_bad_number, {{"file", form.file},
                                          {"line", std::to_string(line(row))},
                                          {"column", name_of(column)},
                                          {"found", std::string(text)}});
}

Result<SourceCells> parse_cells(std::string_view bytes, const std::string& file, const TableOptions& options) {
  if (is_workbook(bytes)) return parse_workbook(bytes, file, options.sheet);
  if (bytes.starts_with("\xD0\xCF\x11\xE0")) {
    return fail(ErrorCode::wrong_format, {{"file", file},
                                          {"found", "an old Excel workbook (.xls)"},
                                          {"expected", "a workbook (.xlsx) or a text table"}});
  }
  SourceCells out;
  out.form.file = file;
  ZD_TRY(DecodedText decoded, decode_text(bytes, file, options.encoding));
  out.form.encoding = std::move(decoded.encoding);
  std::string_view text = decoded.text;
  int line = 1;
  const auto declared = declared_separator(text, line);
  const char separator = !options.separator.empty() ? separator_from(options.separator)
                         : declared                 ? *declared
                                                    : separator_of(text);
  out.form.separator = name_of_separator(separator);
  ZD_TRY(out.cells, split_cells(text, separator, file, line));
  return out;
}

Result<NumberFormat> number_format_of(const Cells& cells, std::size_t first_row, const std::string& file,
                                      const TableOptions& options) {
  if (!options.decimal.empty()) return NumberFormat{options.decimal.front(), true};
  NumberEvidence evidence;
  for (std::size_t row = first_row; row < cells.rows(); ++row) {
    if (cells.is_comment(row)) continue;
    for (std::size_t column = 0; column < cells.columns(row); ++column) {
      const std::string_view cell = cells.at(row, column);
      evidence.add(cell, [&] {
        return NumberEvidence::Place{std::string(cell), cells.line(row), std::to_string(column + 1)};
      });
    }
  }
  return evidence.decide(file);
}

namespace {

/// Why no row has a number: each number has its unit beside it ("20.05 °C"), or there is none.
Error no_rows(const Cells& cells, const std::string& file) {
  for (std::size_t row = 0; row < cells.rows(); ++row) {
    for (std::size_t column = 0; column < cells.columns(row); ++column) {
      const std::string_view cell = cells.at(row, column);
      const std::size_t end = cell.find_first_not_of("+-.,0123456789");
      if (end == 0 || end == std::string_view::npos || !looks_like_number(cell.substr(0, end))) continue;
      if (!is_unit_word(trimmed(cell.substr(end)))) continue;
      return {ErrorCode::column_unclear,
              {{"file", file},
               {"line", std::to_string(cells.line(row))},
               {"column", fmt::format("#{}", column + 1)},
               {"found", std::string(cell)},
               {"expected", "a number alone, and its unit in the heading or in a row of units"}}};
    }
  }
  return {ErrorCode::csv_empty, {{"file", file}}};
}

}  // namespace

Result<SourceTable> find_table(SourceCells source, const TableOptions& options) {
  SourceTable table;
  table.form = std::move(source.form);
  table.cells = std::move(source.cells);
  const auto shape = shape_of(table.cells);
  if (!shape) return fail(no_rows(table.cells, table.form.file));
  const Header header = header_of(table.cells, *shape);
  table.has_header = header.names.has_value();
  if (header.names) {
    table.names = table.cells.row(*header.names);
    while (!table.names.empty() && table.names.back().empty()) table.names.pop_back();
    table.block_end = std::min(*header.names, header.units.value_or(*header.names));
    ZD_CHECK(check_single(table, table.block_end, shape->width));
  } else if (table.form.separator.size() > 0) {
    table.names = names_in_remark(table.cells, *shape, separator_from(table.form.separator));
    table.has_header = !table.names.empty();
  }
  if (table.names.empty()) table.names.resize(shape->width);
  ZD_CHECK(collect_body(table, header, *shape));
  if (table.rows.empty()) return fail(no_rows(table.cells, table.form.file));
  table.units.resize(table.names.size());
  const auto units = header.units ? header.units : labelled_units(table.cells, table.block_end, *shape);
  for (std::size_t column = 0; units && column < table.units.size(); ++column) {
    table.units[column] = table.cells.at(*units, column);
  }
  TableOptions with_block = options;
  if (with_block.decimal.empty()) with_block.decimal = labelled_decimal(table.cells, table.block_end);
  auto numbers = number_format_of(table.cells, table.rows.front(), table.form.file, with_block);
  if (!numbers) {  // by the column's name, which cells alone do not know
    Error error = std::move(numbers).error();
    const std::size_t column = std::stoul(error.context["column"]) - 1;
    if (column < table.names.size()) error.context["column"] = table.name_of(column);
    return fail(std::move(error));
  }
  table.form.numbers = *numbers;
  return table;
}

Result<SourceTable> parse_source_table(std::string_view bytes, const std::string& file, const TableOptions& options) {
  ZD_TRY(SourceCells cells, parse_cells(bytes, file, options));
  return find_table(std::move(cells), options);
}

Result<SourceTable> read_source_table(const std::filesystem::path& path, const TableOptions& options) {
  ZD_TRY(const std::string bytes, read_file(path));
  return parse_source_table(bytes, path.string(), options);
}

}  // namespace zerodrift::recording
