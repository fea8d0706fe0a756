#include "core/compensation/laser_rows.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/recording/import/cell_words.h"

namespace zerodrift::compensation::laser_parts {
namespace {

constexpr const char* direction_expected = "a word for the direction: up or down, + or -, forward or reverse";

/// A reading with what the checks need to know of its row.
struct RowReading {
  RawReading reading;
  int line = 0;
  std::string direction;       // the word in the row; empty: none
  bool by_convention = false;  // that word says nothing of the axis's ends
  bool directed = false;       // direction is known from a word, a name or a title
  bool has_run = false;
};

/// By how much a cell may be off for its last digit, in the column's unit.
double resolution_of(std::string_view cell, char decimal) {
  const std::size_t mark = cell.find(decimal);
  if (mark == std::string_view::npos) return 1.0;
  std::size_t end = mark + 1;
  while (end < cell.size() && cell[end] >= '0' && cell[end] <= '9') ++end;
  return std::pow(10.0, -static_cast<double>(end - mark - 1));
}

Approach other(Approach approach) {
  return approach == Approach::up ? Approach::down : Approach::up;
}

class TableReader {
 public:
  TableReader(const PlannedTable& table, const LaserCells& file, const std::string& axis)
      : m_block(table.block), m_plan(table.plan), m_file(file), m_axis(axis) {}

  Result<std::vector<RowReading>> read() {
    ZD_CHECK(check_validity());
    for (const std::size_t row : m_block.rows) {
      if (!m_axis.empty() && m_plan.axis && m_file.cells.at(row, *m_plan.axis) != m_axis) continue;
      ZD_CHECK(read_row(row));
    }
    return std::move(m_readings);
  }

 private:
  tl::unexpected<Error> bad_cell(std::size_t row, std::size_t column) const {
    return fail(ErrorCode::csv_bad_number, {{"file", m_file.file},
                                            {"line", std::to_string(m_file.cells.line(row))},
                                            {"column", label_of(m_block, column)},
                                            {"found", std::string(m_file.cells.at(row, column))}});
  }
  tl::unexpected<Error> unclear_cell(std::size_t row, std::size_t column, const std::string& expected) const {
    return unclear(m_file.file, m_file.cells.line(row), label_of(m_block, column),
                   std::string(m_file.cells.at(row, column)), expected);
  }

  /// Rows that a column marks as other than the rest may not count; nobody knows which.
  Status check_validity() const {
    for (const std::size_t column : m_plan.validity) {
      const std::string_view first = m_file.cells.at(m_block.rows.front(), column);
      for (const std::size_t row : m_block.rows) {
        if (m_file.cells.at(row, column) != first) {
          return unclear_cell(row, column, "the same in every row, or a file without the rows that do not count");
        }
      }
    }
    return {};
  }

  Result<double> number(std::size_t row, const PlannedColumn& column) const {
    const auto value = m_file.number(row, column.at);
    if (!value) return bad_cell(row, column.at);
    return column.scale * *value + column.offset;
  }
  bool is_missing(std::size_t row, const PlannedColumn& column) const {
    return recording::means_missing(m_file.cells.at(row, column.at));
  }
  Result<double> deviation_um(std::size_t row, const PlannedColumn& column, double target_mm) const {
    ZD_TRY(const double value, number(row, column));
    return column.measured ? um_per_mm * (value - target_mm) : value;
  }
  double resolution_um(std::size_t row, const PlannedColumn& column) const {
    const double one = std::abs(column.scale) * resolution_of(m_file.cells.at(row, column.at), m_file.numbers.decimal);
    return column.measured ? um_per_mm * one : one;
  }

  Status read_row(std::size_t row) {
    const bool none = std::all_of(m_plan.values.begin(), m_plan.values.end(),
                                  [&](const PlannedColumn& value) { return is_missing(row, value); });
    if (none) return {};
    ZD_TRY(const double target_mm, number(row, m_plan.target));
    RowReading one;
    one.reading.target_mm = target_mm;
    one.line = m_file.cells.line(row);
    ZD_CHECK(take_direction(row, one));
    ZD_CHECK(take_run(row, one));
    for (const PlannedColumn& value : m_plan.values) {
      if (is_missing(row, value)) continue;
      RowReading now = one;
      ZD_TRY(now.reading.deviation_um, deviation_um(row, value, target_mm));
      ZD_CHECK(compare(row, value, target_mm, now.reading.deviation_um));
      if (value.approach) now.reading.approach = *value.approach;
      now.directed = now.directed || value.approach;
      if (value.run) {
        now.reading.run = *value.run;
        now.has_run = true;
      }
      m_readings.push_back(std::move(now));
    }
    return {};
  }

  Status take_direction(std::size_t row, RowReading& one) {
    if (m_plan.approach) {
      one.reading.approach = *m_plan.approach;
      one.directed = true;
    }
    if (!m_plan.direction) return {};
    const std::string_view cell = m_file.cells.at(row, *m_plan.direction);
    const auto [at, is_new] = m_words.try_emplace(std::string(cell));
    if (is_new) at->second = direction_word(cell);
    const std::optional<DirectionWord>& word = at->second;
    if (!word) return unclear_cell(row, *m_plan.direction, direction_expected);
    if (m_plan.approach && word->approach != *m_plan.approach) {
      return unclear_cell(row, *m_plan.direction, "the direction that stands above the table");
    }
    one.reading.approach = word->approach;
    one.direction = cell;
    one.by_convention = word->by_convention;
    one.directed = true;
    return {};
  }

  Status take_run(std::size_t row, RowReading& one) const {
    if (m_plan.table_run) {
      one.reading.run = *m_plan.table_run;
      one.has_run = true;
    }
    if (!m_plan.run) return {};
    const auto value = m_file.number(row, *m_plan.run);
    const auto run = value ? run_number(*value) : run_in_cell(m_file.cells.at(row, *m_plan.run));
    if (!run) return bad_cell(row, *m_plan.run);
    one.reading.run = *run;
    one.has_run = true;
    return {};
  }

  /// What stands in the file twice must say the same twice.
  Status compare(std::size_t row, const PlannedColumn& value, double target_mm, double um) const {
    for (const PlannedColumn& again : m_plan.same) {
      if (again.approach != value.approach || again.run != value.run || is_missing(row, again)) continue;
      ZD_TRY(const double other_um, deviation_um(row, again, target_mm));
      const double target_um = um_per_mm * m_plan.target.scale *
                               resolution_of(m_file.cells.at(row, m_plan.target.at), m_file.numbers.decimal);
      // A target is exact as a rule; of a measured one in other units its last digit counts too.
      const double exact = value.measured || again.measured ? std::min(target_um, 1.0) : 0.0;
      const double rounding_um = resolution_um(row, value) + resolution_um(row, again) + exact;
      if (std::abs(other_um - um) <= rounding_um) continue;
      const bool turned = std::abs(other_um + um) <= rounding_um;
      return unclear(m_file.file, m_file.cells.line(row), label_of(m_block, again.at),
                     turned
                         ? fmt::format("{:.4g} um where {} says {:.4g} um: the sign is turned", other_um,
                                       label_of(m_block, value.at), um)
                         : fmt::format("{:.4g} um where {} says {:.4g} um", other_um, label_of(m_block, value.at), um),
                     "the same reading (error = actual - target)");
    }
    return {};
  }

  const LaserBlock& m_block;
  const TablePlan& m_plan;
  const LaserCells& m_file;
  const std::string& m_axis;
  std::map<std::string, std::optional<DirectionWord>> m_words;  // met so far
  std::vector<RowReading> m_readings;
};

/// How the positions go from one reading of a direction to its next.
struct Steps {
  int rising = 0;
  int falling = 0;
};

/// "up" where positions rise, or where they say nothing; words of convention need the order's word.
Status check_order(const std::vector<RowReading>& readings, const std::string& file) {
  Steps steps[2];
  const RowReading* before[2] = {nullptr, nullptr};
  const RowReading* convention = nullptr;
  for (const RowReading& one : readings) {
    if (!one.direction.empty() && one.by_convention && convention == nullptr) convention = &one;
    const int side = one.reading.approach == Approach::up ? 0 : 1;
    if (before[side] != nullptr && before[side]->reading.run == one.reading.run) {
      steps[side].rising += one.reading.target_mm > before[side]->reading.target_mm ? 1 : 0;
      steps[side].falling += one.reading.target_mm < before[side]->reading.target_mm ? 1 : 0;
    }
    before[side] = &one;
  }
  const bool up_rises = steps[0].rising > 2 * steps[0].falling;
  const bool up_falls = steps[0].falling > 2 * steps[0].rising;
  const bool down_rises = steps[1].rising > 2 * steps[1].falling;
  const bool down_falls = steps[1].falling > 2 * steps[1].rising;
  const bool contrary = (up_falls && (down_rises || before[1] == nullptr)) || (down_rises && up_falls);
  const auto first =
      std::find_if(readings.begin(), readings.end(), [](const auto& one) { return !one.direction.empty(); });
  if (contrary && before[1] != nullptr && first != readings.end()) {
    return unclear(file, first->line, "direction",
                   fmt::format("{}, while the positions go the other way", first->direction),
                   "directions along the positions as they were driven");
  }
  if (convention == nullptr) return {};
  const bool borne_out = up_rises && (before[1] == nullptr || down_falls);
  if (borne_out) return {};
  return unclear(file, convention->line, "direction",
                 fmt::format("{}, which may mean either end", convention->direction),
                 "positions in the order they were driven, or forward and reverse");
}

/// The same target once more is the turning point: the axis went beyond and came back.
Approach way_from(double before_mm, double now_mm, Approach way) {
  if (now_mm == before_mm) return other(way);
  return now_mm > before_mm ? Approach::up : Approach::down;
}

/// Directions where nothing says them: there and back as they were driven, else one direction.
Result<bool> direct_by_order(std::vector<RowReading>& readings, bool settled, const std::string& file) {
  int rising = 0;
  int falling = 0;
  std::map<double, int> visits;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    ++visits[readings[i].reading.target_mm];
    if (i == 0) continue;
    rising += readings[i].reading.target_mm > readings[i - 1].reading.target_mm ? 1 : 0;
    falling += readings[i].reading.target_mm < readings[i - 1].reading.target_mm ? 1 : 0;
  }
  const bool once = std::all_of(visits.begin(), visits.end(), [](const auto& one) { return one.second == 1; });
  if (!settled) {
    // One step back a pass is a run that begins again; there and back falls as often as it rises.
    const int most = std::max(rising, falling);
    const int least = std::min(rising, falling);
    if (once || 3 * least <= most) return false;
    int turns = 0;
    for (std::size_t i = 2; i < readings.size(); ++i) {
      const double one = readings[i - 1].reading.target_mm - readings[i - 2].reading.target_mm;
      const double two = readings[i].reading.target_mm - readings[i - 1].reading.target_mm;
      turns += one * two < 0.0 ? 1 : 0;
    }
    if (3 * turns > rising + falling) {
      return unclear(file, readings[1].line, "direction", "none, and positions in no order of a drive",
                     "a column that says the direction of each reading");
    }
  }
  Approach way = readings.size() > 1 && readings[1].reading.target_mm < readings[0].reading.target_mm ? Approach::down
                                                                                                      : Approach::up;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (i > 0) way = way_from(readings[i - 1].reading.target_mm, readings[i].reading.target_mm, way);
    readings[i].reading.approach = way;
  }
  return true;
}

/// The axes of the tables' columns, and the one asked for.
Status choose_axis(const std::vector<PlannedTable>& tables, const LaserCells& file, const LaserOptions& options,
                   ReadRows& out) {
  for (const auto& [block, plan] : tables) {
    if (!plan.axis) continue;
    for (const std::size_t row : block.rows) {
      const std::string name(file.cells.at(row, *plan.axis));
      if (std::find(out.axes.begin(), out.axes.end(), name) == out.axes.end()) out.axes.push_back(name);
    }
  }
  if (out.axes.empty()) return {};
  out.axis = out.axes.front();
  if (out.axes.size() == 1) return {};
  const auto wanted = std::find_if(out.axes.begin(), out.axes.end(),
                                   [&](const auto& name) { return lowered(name) == lowered(options.axis); });
  if (wanted == out.axes.end()) {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the axes in " + file.file},
                 {"found", fmt::format("{}", fmt::join(out.axes, ", "))},
                 {"expected", options.axis.empty() ? "one, or the choice of one of them" : "axis " + options.axis}});
  }
  out.axis = *wanted;
  return {};
}

/// "1" beside "-1" or "+1" is no convention.
void settle_signed_ones(std::vector<RowReading>& readings) {
  const bool with_sign = std::any_of(readings.begin(), readings.end(), [](const auto& one) {
    const std::string word = normalised(one.direction);
    return word == "-1" || word == "+1";
  });
  for (RowReading& one : readings) one.by_convention = one.by_convention && !(with_sign && one.direction == "1");
}

}  // namespace

Result<ReadRows> read_rows(const std::vector<PlannedTable>& tables, const LaserCells& file,
                           const LaserOptions& options) {
  ReadRows out;
  ZD_CHECK(choose_axis(tables, file, options, out));
  std::vector<RowReading> all;
  for (const PlannedTable& table : tables) {
    ZD_TRY(auto readings, TableReader(table, file, out.axis).read());
    const bool said = std::any_of(readings.begin(), readings.end(), [](const auto& one) { return one.directed; });
    if (!said && table.plan.values.size() == 1) {
      ZD_TRY(const bool by_order, direct_by_order(readings, table.plan.direction_from_order, file.file));
      out.from_order = out.from_order || by_order;
    }
    all.insert(all.end(), readings.begin(), readings.end());
  }
  const bool directed = std::any_of(all.begin(), all.end(), [](const auto& one) { return one.directed; });
  if (directed) {
    settle_signed_ones(all);
    ZD_CHECK(check_order(all, file.file));
  }
  std::map<std::pair<double, int>, int> seen;  // target and direction -> readings so far, where no run is given
  for (RowReading& one : all) {
    const int count = ++seen[{one.reading.target_mm, one.reading.approach == Approach::up ? 0 : 1}];
    if (!one.has_run) one.reading.run = count;
    out.readings.push_back(one.reading);
  }
  return out;
}

}  // namespace zerodrift::compensation::laser_parts
