#pragma once
// The cells of a file in their rows, whatever the file was: a text table split at its separator, or a sheet of a
// workbook. Each row knows the line (or the row of the sheet) it came from.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::recording {

class Cells {
 public:
  std::size_t rows() const { return m_lines.size(); }
  /// Cells of a row, empty ones at its end included.
  std::size_t columns(std::size_t row) const;
  /// Empty beyond the row's end.
  std::string_view at(std::size_t row, std::size_t column) const;
  int line(std::size_t row) const { return m_lines[row]; }
  /// A line that begins with #, // or %: a remark, one cell.
  bool is_comment(std::size_t row) const { return m_comment[row]; }
  bool is_blank(std::size_t row) const;
  std::vector<std::string> row(std::size_t row) const;

  void begin_row(int line, bool comment = false);
  void add(std::string_view text);

 private:
  std::string m_text;                // all cells, one after the other
  std::vector<std::size_t> m_ends;   // of each cell in m_text
  std::vector<std::size_t> m_first;  // of each row in m_ends
  std::vector<int> m_lines;
  std::vector<bool> m_comment;
};

inline constexpr char separated_by_blanks = ' ';

/// Splits text (UTF-8) at a separator, separated_by_blanks: at any run of blanks and tabs. Lines end with CR, LF or
/// CRLF; quotes as in RFC 4180. A quote that never closes is quote_open.
Result<Cells> split_cells(std::string_view text, char separator, const std::string& file, int first_line = 1);

/// What separates the cells of a text, from its lines: tab, semicolon, comma, bar or blanks, whichever leaves cells
/// that are numbers, times and words for them, the same number in nearly all lines.
char separator_of(std::string_view text);
/// "," ";" "|" "tab" or "blanks".
std::string name_of_separator(char separator);

/// A number, a time, or a word that means a missing sample or a switch; an empty cell is none of them.
bool is_value(std::string_view cell);

/// What a spreadsheet would take for a formula, had it not the apostrophe before it that marks text there; any number
/// of apostrophes, so that one more and one less are each other's way back.
bool is_formula(std::string_view text);
/// Without blanks at both ends.
std::string_view trimmed(std::string_view text);

}  // namespace zerodrift::recording
