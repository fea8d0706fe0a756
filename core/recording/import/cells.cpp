#include "core/recording/import/cells.h"

#include <algorithm>
#include <array>
#include <map>

#include "core/recording/import/cell_words.h"
#include "core/recording/import/clock_text.h"
#include "core/recording/import/number_format.h"

namespace zerodrift::recording {
namespace {

constexpr std::size_t sample_bytes = 1 << 17;  // of a text, to find its separator
constexpr std::size_t sample_lines = 8;        // at least, however long they are

bool is_blank_or_tab(char c) {
  return c == ' ' || c == '\t';
}

bool is_comment_line(std::string_view line, char separator) {
  line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
  if (line.starts_with('#')) {
    // "#" may be the name of the first column.
    const bool name = line.size() > 1 && line[1] == separator && separator != separated_by_blanks;
    return !name && !line.starts_with("#N/A");
  }
  return line.starts_with("//") || line.starts_with("% ");
}

std::string_view next_line(std::string_view& text) {
  const std::size_t end = text.find_first_of("\r\n");
  const std::string_view line = text.substr(0, end);
  if (end == std::string_view::npos) {
    text = {};
  } else {
    text.remove_prefix(end + (text[end] == '\r' && end + 1 < text.size() && text[end + 1] == '\n' ? 2 : 1));
  }
  return line;
}

/// One row from the front of the text; its cells may hold line ends where they are quoted.
class RowReader {
 public:
  RowReader(std::string_view& text, char separator, int& line) : m_text(text), m_separator(separator), m_line(line) {}

  /// False where a quote never closes.
  bool read(Cells& cells) {
    const bool blanks = m_separator == separated_by_blanks;
    while (true) {
      if (blanks) skip_blanks();
      if (blanks && at_line_end()) break;
      if (!read_cell(cells)) return false;
      if (at_line_end()) break;
      m_text.remove_prefix(1);  // the separator
    }
    take_line_end();
    return true;
  }

 private:
  bool at_line_end() const { return m_text.empty() || m_text.front() == '\n' || m_text.front() == '\r'; }
  bool at_separator() const {
    return m_separator == separated_by_blanks ? is_blank_or_tab(m_text.front()) : m_text.front() == m_separator;
  }
  void skip_blanks() {
    while (!m_text.empty() && is_blank_or_tab(m_text.front())) m_text.remove_prefix(1);
  }
  void take_line_end() {
    if (m_text.empty()) return;
    const bool two = m_text.starts_with("\r\n");
    m_text.remove_prefix(two ? 2 : 1);
    ++m_line;
  }

  bool read_cell(Cells& cells) {
    std::string_view ahead = m_text;
    while (!ahead.empty() && (ahead.front() == ' ' || (ahead.front() == '\t' && m_separator != '\t'))) {
      ahead.remove_prefix(1);
    }
    if (ahead.starts_with('"')) {
      m_text = ahead.substr(1);
      return read_quoted(cells);
    }
    std::size_t end = 0;
    while (end < m_text.size() && m_text[end] != '\n' && m_text[end] != '\r' &&
           !(m_separator == separated_by_blanks ? is_blank_or_tab(m_text[end]) : m_text[end] == m_separator)) {
      ++end;
    }
    add(cells, trimmed(m_text.substr(0, end)));
    m_text.remove_prefix(end);
    return true;
  }

  bool read_quoted(Cells& cells) {
    std::string cell;
    while (true) {
      const std::size_t end = m_text.find('"');
      if (end == std::string_view::npos) return false;
      cell += m_text.substr(0, end);
      m_line += static_cast<int>(std::count(m_text.begin(), m_text.begin() + static_cast<std::ptrdiff_t>(end), '\n'));
      m_text.remove_prefix(end + 1);
      if (!m_text.starts_with('"')) break;
      cell += '"';
      m_text.remove_prefix(1);
    }
    while (!at_line_end() && !at_separator()) {  // what follows the quote belongs to the cell, blanks apart
      if (m_text.front() != ' ') cell += m_text.front();
      m_text.remove_prefix(1);
    }
    add(cells, cell);
    return true;
  }

  static void add(Cells& cells, std::string_view text) {
    if (text.starts_with('\'') && is_formula(text)) text.remove_prefix(1);
    cells.add(text);
  }

  std::string_view& m_text;
  char m_separator;
  int& m_line;
};

/// Whole lines from the front, so many bytes, or some lines where they are long.
std::string_view sample_of(std::string_view text) {
  if (text.size() <= sample_bytes) return text;
  std::size_t end = 0;
  std::size_t lines = 0;
  while (end < text.size() && (end < sample_bytes || lines < sample_lines)) {
    end = std::min(text.find_first_of("\r\n", end), text.size() - 1) + 1;
    ++lines;
  }
  return text.substr(0, end);
}

/// How well a separator splits: the share of rows as wide as most, times the share of values among the cells of those
/// of them that hold any.
double fitness(std::string_view sample, char separator) {
  const auto cells = split_cells(sample, separator, {});
  if (!cells) return 0.0;
  std::map<std::size_t, std::size_t> widths;
  std::size_t rows = 0;
  for (std::size_t row = 0; row < cells->rows(); ++row) {
    if (cells->is_comment(row) || cells->is_blank(row)) continue;
    ++rows;
    ++widths[cells->columns(row)];
  }
  double best = 0.0;
  for (const auto& [width, count] : widths) {
    if (width < 2) continue;
    std::size_t values = 0;
    std::size_t filled = 0;
    for (std::size_t row = 0; row < cells->rows(); ++row) {
      if (cells->columns(row) != width) continue;
      std::size_t values_here = 0;
      std::size_t filled_here = 0;
      for (std::size_t column = 0; column < width; ++column) {
        const std::string_view cell = cells->at(row, column);
        filled_here += !cell.empty();
        values_here += is_value(cell);
      }
      if (values_here == 0) continue;  // a header says nothing here
      values += values_here;
      filled += filled_here;
    }
    filled = std::max<std::size_t>(filled, 1);
    const double share = static_cast<double>(count) / static_cast<double>(rows);
    // Tables of words have a separator, too.
    best = std::max(best, share * (0.01 + static_cast<double>(values) / static_cast<double>(filled)));
  }
  return best;
}

}  // namespace

std::size_t Cells::columns(std::size_t row) const {
  return (row + 1 < m_first.size() ? m_first[row + 1] : m_ends.size()) - m_first[row];
}

std::string_view Cells::at(std::size_t row, std::size_t column) const {
  if (column >= columns(row)) return {};
  const std::size_t cell = m_first[row] + column;
  const std::size_t begin = cell == 0 ? 0 : m_ends[cell - 1];
  return std::string_view(m_text).substr(begin, m_ends[cell] - begin);
}

bool Cells::is_blank(std::size_t row) const {
  for (std::size_t column = 0; column < columns(row); ++column) {
    if (!at(row, column).empty()) return false;
  }
  return true;
}

std::vector<std::string> Cells::row(std::size_t row) const {
  std::vector<std::string> out;
  for (std::size_t column = 0; column < columns(row); ++column) out.emplace_back(at(row, column));
  return out;
}

void Cells::begin_row(int line, bool comment) {
  m_first.push_back(m_ends.size());
  m_lines.push_back(line);
  m_comment.push_back(comment);
}

void Cells::add(std::string_view text) {
  m_text += text;
  m_ends.push_back(m_text.size());
}

Result<Cells> split_cells(std::string_view text, char separator, const std::string& file, int first_line) {
  Cells cells;
  int line = first_line;
  RowReader reader(text, separator, line);
  while (!text.empty()) {
    if (is_comment_line(text, separator)) {
      cells.begin_row(line++, true);
      cells.add(next_line(text));
      continue;
    }
    const int begin = line;
    cells.begin_row(begin);
    if (!reader.read(cells)) {
      return fail(ErrorCode::quote_open, {{"file", file}, {"line", std::to_string(begin)}});
    }
  }
  return cells;
}

char separator_of(std::string_view text) {
  const std::string_view sample = sample_of(text);
  char best = ',';
  double fittest = 0.0;
  for (const char candidate : {'\t', ';', ',', '|', separated_by_blanks}) {
    // Blanks stand between words, too: only where nothing else splits as well.
    const double fit = fitness(sample, candidate) * (candidate == separated_by_blanks ? 0.8 : 1.0);
    if (fit > fittest + 1e-9) {
      fittest = fit;
      best = candidate;
    }
  }
  return best;
}

std::string name_of_separator(char separator) {
  if (separator == '\t') return "tab";
  if (separator == separated_by_blanks) return "blanks";
  return std::string(1, separator);
}

bool is_value(std::string_view cell) {
  if (cell.empty()) return false;
  return looks_like_number(cell) || means_missing(cell) || switch_value(cell) || read_clock_text(cell);
}

bool is_formula(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return !text.empty() && std::string_view("=+-@\t\r\n").find(text.front()) != std::string_view::npos && text != "-" &&
         !looks_like_number(text);
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r\v\f";
  constexpr std::string_view no_break_space = "\xC2\xA0";
  while (!text.empty()) {
    if (blanks.find(text.front()) != std::string_view::npos) {
      text.remove_prefix(1);
    } else if (text.starts_with(no_break_space)) {
      text.remove_prefix(2);
    } else {
      break;
    }
  }
  while (!text.empty()) {
    if (blanks.find(text.back()) != std::string_view::npos) {
      text.remove_suffix(1);
    } else if (text.ends_with(no_break_space)) {
      text.remove_suffix(2);
    } else {
      break;
    }
  }
  return text;
}

}  // namespace zerodrift::recording
