// Readings of a table whose columns were settled: by the user, or by names that leave no doubt.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/compensation/laser_parts.h"

namespace zerodrift::compensation::laser_parts {

namespace {

constexpr double most_runs = 1e6;  // a number beyond names no run

/// Readings of one row; runs of the columns are counted from 1 in each direction.
struct MappedRow {
  double position_mm = 0.0;
  std::optional<Approach> approach;
  std::optional<int> run;
};

struct Cell {
  std::size_t column = 0;
  double um = 0.0;
};

/// The same target once more is the turning point: the axis went beyond and came back.
Approach way_from(double before_mm, double now_mm, Approach way) {
  if (now_mm == before_mm) return way == Approach::up ? Approach::down : Approach::up;
  return now_mm > before_mm ? Approach::up : Approach::down;
}

/// One line of the table into its readings.
class MappedReader {
 public:
  MappedReader(const std::string& file, const LaserMapping& mapping) : m_file(file), m_mapping(mapping) {}

  /// False when the table is over.
  Result<bool> take(const Line& line, std::size_t position_column) {
    const auto cells = cells_of_line(line.text, m_mapping.separator);
    const auto position =
        position_column < cells.size() ? number_in_cell(cells[position_column], m_mapping.decimal_comma) : std::nullopt;
    if (!position) {
      if (cells.size() != m_mapping.columns.size() && !m_readings.empty()) return false;
      return bad_cell(line, "position", std::string(line.text.substr(0, 60)));
    }
    MappedRow row{*position * m_mapping.mm_per_position, {}, {}};
    if (m_before_mm) m_way = way_from(*m_before_mm, row.position_mm, m_way);
    m_before_mm = row.position_mm;
    const std::size_t count = std::min(cells.size(), m_mapping.columns.size());
    std::vector<Cell> values;
    for (std::size_t i = 0; i < count; ++i) {
      const LaserColumn role = m_mapping.columns[i];
      if (role == LaserColumn::direction) row.approach = approach_word(cells[i]);
      if (role == LaserColumn::run) {
        if (const auto run = number_in_cell(cells[i], m_mapping.decimal_comma)) row.run = run_number(*run);
      }
      if ((!is_error(role) && !is_measured(role)) || cells[i].empty()) continue;  // empty: not measured here
      const auto value = number_in_cell(cells[i], m_mapping.decimal_comma);
      if (!value) return bad_cell(line, std::string(name_of(role)), cells[i]);
      values.push_back({i, um_of(role, *value, row.position_mm)});
    }
    keep(row, values);
    return true;
  }
  std::vector<RawReading> readings() { return std::move(m_readings); }

 private:
  tl::unexpected<Error> bad_cell(const Line& line, const std::string& column, const std::string& found) const {
    return fail(ErrorCode::csv_bad_number,
                {{"file", m_file}, {"line", std::to_string(line.number)}, {"column", column}, {"found", found}});
  }

  double um_of(LaserColumn role, double value, double position_mm) const {
    if (is_error(role)) return (m_mapping.negated ? -1.0 : 1.0) * value * m_mapping.um_per_error;
    return 1000.0 * (value * m_mapping.mm_per_position - position_mm);
  }

  void keep(const MappedRow& row, const std::vector<Cell>& values) {
    for (const Cell& cell : values) {
      const LaserColumn role = m_mapping.columns[cell.column];
      Approach approach = row.approach.value_or(m_mapping.direction_from_order ? m_way : Approach::up);
      if (role == LaserColumn::error_up || role == LaserColumn::measured_up) approach = Approach::up;
      if (role == LaserColumn::error_down || role == LaserColumn::measured_down) approach = Approach::down;
      const int count = ++m_seen[{row.position_mm, approach == Approach::up ? 0 : 1}];
      m_readings.push_back({row.position_mm, approach, values.size() == 1 ? row.run.value_or(count) : count, cell.um});
    }
  }

  const std::string& m_file;
  const LaserMapping& m_mapping;
  std::vector<RawReading> m_readings;
  std::map<std::pair<double, int>, int> m_seen;  // target and direction -> readings so far
  std::optional<double> m_before_mm;
  Approach m_way = Approach::up;
};

}  // namespace

Result<LaserReport> parse_mapped(std::string_view text, const std::string& file, const LaserMapping& mapping,
                                 const LaserOptions& options) {
  const auto at = std::find(mapping.columns.begin(), mapping.columns.end(), LaserColumn::position);
  if (at == mapping.columns.end()) {
    return fail(
        ErrorCode::bad_argument,
        {{"what", "the columns of " + file}, {"found", "no position"}, {"expected", "one column of positions"}});
  }
  MappedReader reader(file, mapping);
  for (const Line& line : lines_of(text)) {
    if (line.number < mapping.first_line || line.text.empty()) continue;
    ZD_TRY(const bool more, reader.take(line, static_cast<std::size_t>(at - mapping.columns.begin())));
    if (!more) break;
  }
  ZD_TRY(LaserReport report, assemble(reader.readings(), file, options));
  report.warnings.push_back(fmt::format("{}: read as: {}; confirm the sign on one point", file, describe(mapping)));
  return report;
}

std::vector<std::string> cells_of_line(std::string_view line, char separator) {
  if (separator == ' ') {
    std::vector<std::string> words;
    std::string word;
    for (const char c : line) {
      if (c != ' ' && c != '\t') {
        word += c;
      } else if (!word.empty()) {
        words.push_back(std::move(word));
        word.clear();
      }
    }
    if (!word.empty()) words.push_back(std::move(word));
    return words;
  }
  std::vector<std::string> cells;
  for (;;) {
    const auto end = line.find(separator);
    std::string_view cell = line.substr(0, end);
    const auto first = cell.find_first_not_of(" \t\"");
    const auto last = cell.find_last_not_of(" \t\"");
    cells.emplace_back(first == std::string_view::npos ? std::string_view{} : cell.substr(first, last - first + 1));
    if (end == std::string_view::npos) return cells;
    line.remove_prefix(end + 1);
  }
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return c < 0x80 ? static_cast<char>(std::tolower(c)) : static_cast<char>(c); });
  return text;
}

std::optional<double> number_in_cell(std::string cell, bool decimal_comma) {
  if (decimal_comma) {
    const auto comma = cell.find(',');
    if (comma != std::string::npos) {
      if (cell.find('.') != std::string::npos) return {};
      cell[comma] = '.';
    }
  }
  return number_from(cell);
}

std::optional<int> run_number(double value) {
  if (value < 0.0 || value > most_runs || value != std::floor(value)) return {};
  return static_cast<int>(value);
}

std::optional<Approach> approach_word(std::string word) {
  word = lowered(std::move(word));
  for (const char* up : {"up", "forward", "fwd", "positive", "+", "1", "+1", "u", "f", "正", "正向"}) {
    if (word == up) return Approach::up;
  }
  for (const char* down :
       {"down", "backward", "bwd", "reverse", "negative", "-", "-1", "0", "2", "d", "b", "r", "负", "负向", "反向"}) {
    if (word == down) return Approach::down;
  }
  return {};
}

}  // namespace zerodrift::compensation::laser_parts
