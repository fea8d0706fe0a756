#pragma once
// A table as it is in a file: where its header, its units row and its rows are, what its numbers look like. Nothing
// here knows what a column means. Lines before the header (a logger's block of settings) stay readable.

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/recording/import/cells.h"
#include "core/recording/import/number_format.h"

namespace zerodrift::recording {

/// What the user says of a file; empty: found from the file.
struct TableOptions {
  std::string encoding;
  std::string separator;  // one character, "tab" or "blanks"
  std::string decimal;    // "." or ","
  std::string sheet;      // of a workbook
};

/// How the bytes became cells.
struct TableForm {
  std::string file;
  std::string encoding;   // "xlsx" for a workbook
  std::string separator;  // as name_of_separator; empty for a workbook
  std::string sheet;      // of a workbook
  NumberFormat numbers;
};

class SourceTable {
 public:
  TableForm form;
  Cells cells;
  std::vector<std::size_t> rows;   // of `cells`: the table's body
  std::vector<std::string> names;  // of the columns as the header has them, trimmed; "" where there is none
  std::vector<std::string> units;  // of the units row; "" where there is none
  std::size_t block_end = 0;       // rows of `cells` before it stand before the table
  bool has_header = false;
  std::vector<Error> remarks;  // what was passed over: repeated headers, lines of words

  std::size_t columns() const { return names.size(); }
  /// The first column of this name, or -1.
  int column(std::string_view name) const;
  std::string_view cell(std::size_t row, std::size_t column) const { return cells.at(rows[row], column); }
  int line(std::size_t row) const { return cells.line(rows[row]); }
  /// For messages: the name, or "#3" where the column has none.
  std::string name_of(std::size_t column) const;
  /// A missing sample is NaN; a cell that is no number is csv_bad_number with line and column.
  Result<double> number(std::size_t row, std::size_t column) const;
};

/// The cells of a file and how they were found; a line "sep=;" is obeyed and left out. For readers that find their own
/// tables in them. The number format stays undecided: a point.
struct SourceCells {
  TableForm form;
  Cells cells;
};
Result<SourceCells> parse_cells(std::string_view bytes, const std::string& file, const TableOptions& options = {});

/// The number format of these cells, from all rows from `first_row` on.
Result<NumberFormat> number_format_of(const Cells& cells, std::size_t first_row, const std::string& file,
                                      const TableOptions& options = {});

/// Finds the table in cells. csv_empty, csv_cell_count and number errors name lines; a table without header has
/// has_header false and columns without names.
Result<SourceTable> find_table(SourceCells source, const TableOptions& options = {});

/// Bytes to table in one go.
Result<SourceTable> parse_source_table(std::string_view bytes, const std::string& file,
                                       const TableOptions& options = {});
Result<SourceTable> read_source_table(const std::filesystem::path& path, const TableOptions& options = {});

}  // namespace zerodrift::recording
