#include "core/compensation/laser_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "core/compensation/laser_parts.h"

namespace zerodrift::compensation::laser_parts {
namespace {

constexpr const char* known_length_units = "a unit of length: mm, um, in, uin, mil";

/// What the lines above a table say of units: "Position unit: mm", "Einheit: mm".
struct TitleUnits {
  std::optional<Unit> target;
  std::optional<Unit> error;
};

TitleUnits units_in_titles(const std::vector<std::string>& titles) {
  TitleUnits units;
  for (const std::string& title : titles) {
    const std::string text = normalised(title);
    const auto word = std::min({text.find("unit"), text.find("einheit"), text.find("单位")});
    const auto colon = text.find_last_of(":=");
    if (word == std::string::npos) continue;
    const auto unit = unit_of(colon == std::string::npos ? text.substr(std::min(text.find(' ', word), text.size()))
                                                         : text.substr(colon + 1));
    if (!unit) continue;
    const bool of_target = text.find("pos") != std::string::npos || text.find("target") != std::string::npos ||
                           text.find("soll") != std::string::npos || text.find("位置") != std::string::npos;
    const bool of_error = text.find("err") != std::string::npos || text.find("dev") != std::string::npos ||
                          text.find("abweich") != std::string::npos || text.find("fehler") != std::string::npos ||
                          text.find("误差") != std::string::npos || text.find("偏差") != std::string::npos;
    if (of_error || of_target) (of_error ? units.error : units.target) = unit;
  }
  return units;
}

class Planner {
 public:
  Planner(const LaserBlock& block, const LaserCells& file, std::vector<ColumnFate>& fates)
      : m_block(block), m_file(file), m_fates(fates), m_units(units_in_titles(block.titles)) {}

  Result<TablePlan> plan() {
    ZD_CHECK(check_header());
    ZD_CHECK(check_titles());
    ZD_CHECK(sort_columns());
    ZD_CHECK(choose_target());
    ZD_CHECK(choose_values());
    ZD_CHECK(check_directions());
    m_plan.approach = direction_of_table();
    m_plan.table_run = run_of_table();
    return m_plan;
  }

 private:
  using Indices = std::vector<std::size_t>;

  const ColumnName& name(std::size_t column) const { return m_block.columns[column]; }
  std::string label(std::size_t column) const { return label_of(m_block, column); }
  void leave_out(std::size_t column, const std::string& why) { m_fates.push_back({label(column), why}); }
  tl::unexpected<Error> refuse(std::size_t column, const std::string& found, const std::string& expected) const {
    return unclear(m_file.file, m_block.header_line > 0 ? m_block.header_line : m_file.cells.line(m_block.rows.front()),
                   label(column), found, expected);
  }

  std::vector<std::string> filled_cells(std::size_t column) const {
    std::vector<std::string> cells;
    for (const std::size_t row : m_block.rows) {
      if (!m_file.cells.at(row, column).empty()) cells.emplace_back(m_file.cells.at(row, column));
    }
    return cells;
  }

  Status sort_columns() {
    for (std::size_t k = 0; k < m_block.width; ++k) {
      if (name(k).sign_or_factor) {
        return refuse(k, "a sign or a factor in its name",
                      "actual - target in a unit; say other ones with a column map");
      }
      switch (name(k).role) {
        case ColumnRole::target:
          m_targets.push_back(k);
          break;
        case ColumnRole::measured:
          m_measured.push_back(k);
          break;
        case ColumnRole::error:
          m_errors.push_back(k);
          break;
        case ColumnRole::compensation:
          m_compensations.push_back(k);
          break;
        case ColumnRole::direction:
          ZD_CHECK(take_one(k, m_plan.direction));
          break;
        case ColumnRole::run:
          ZD_CHECK(take_one(k, m_plan.run));
          break;
        case ColumnRole::axis:
          ZD_CHECK(take_one(k, m_plan.axis));
          break;
        case ColumnRole::validity:
          m_plan.validity.push_back(k);
          leave_out(k, "says whether a row counts");
          break;
        case ColumnRole::remark:
          leave_out(k, name(k).unit && name(k).unit->kind == UnitKind::other
                           ? fmt::format("not used: in {}", name(k).unit->name)
                           : std::string("not used: no reading"));
          break;
        case ColumnRole::unknown:
          ZD_CHECK(take_unknown(k));
          break;
      }
    }
    return {};
  }

  Status take_one(std::size_t column, std::optional<std::size_t>& place) {
    if (filled_cells(column).empty()) {
      leave_out(column, "not used: empty");
      return {};
    }
    if (place) return refuse(column, fmt::format("a second column like {}", label(*place)), "one of them");
    place = column;
    return {};
  }

  /// Words nobody needs may stand anywhere; numbers, and words of which there are few, may change what is read.
  Status take_unknown(std::size_t column) {
    const std::vector<std::string> cells = filled_cells(column);
    if (cells.empty()) {
      leave_out(column, "not used: empty");
      return {};
    }
    const bool directions = std::all_of(cells.begin(), cells.end(), [](const auto& cell) {
      return direction_word(cell).has_value() && !recording::looks_like_number(cell);
    });
    if (directions && !m_plan.direction) {
      m_plan.direction = column;
      return {};
    }
    const bool numbers =
        std::any_of(cells.begin(), cells.end(), [](const auto& cell) { return recording::looks_like_number(cell); });
    const std::set<std::string> distinct(cells.begin(), cells.end());
    constexpr std::size_t few = 3;
    if (!numbers && (distinct.size() == 1 || (distinct.size() > few && distinct.size() * 2 > cells.size()))) {
      const bool unit = distinct.size() == 1 && unit_of(cells.front());
      if (!unit) {
        leave_out(column, "not used: words");
        return {};
      }
    }
    return refuse(column, numbers ? "numbers of unknown meaning" : "words of unknown meaning",
                  "a name that says what it holds");
  }

  /// Positions and readings, whatever else there is.
  Status check_header() const {
    bool target = false;
    bool reading = false;
    for (const ColumnName& column : m_block.columns) {
      target = target || column.role == ColumnRole::target;
      reading = reading || column.role == ColumnRole::error || column.role == ColumnRole::measured ||
                column.role == ColumnRole::compensation;
    }
    if (target && reading) return {};
    std::string found;
    for (const ColumnName& column : m_block.columns) found += (found.empty() ? "" : ",") + column.text;
    return fail(ErrorCode::csv_bad_header, {{"file", m_file.file},
                                            {"line", std::to_string(m_block.header_line)},
                                            {"column", target ? "error_um" : "position_mm"},
                                            {"found", found},
                                            {"expected", expected_forms}});
  }

  /// A sign convention or a factor above the table would change every reading.
  Status check_titles() const {
    for (const std::string& title : m_block.titles) {
      if (!says_sign_or_factor(title)) continue;
      return unclear(m_file.file, m_block.header_line, label(0), title,
                     "actual - target in a unit; say other ones with a column map");
    }
    return {};
  }

  Status choose_target() {
    Indices lengths;
    for (const std::size_t k : m_targets) {
      const auto& unit = name(k).unit ? name(k).unit : m_units.target;
      if (unit && unit->kind == UnitKind::angle) {
        return fail(ErrorCode::wrong_format,
                    {{"file", m_file.file},
                     {"found", fmt::format("of a rotary axis (column {} is in {})", label(k), unit->name)},
                     {"expected", "positions of a linear axis; rotary axes are not compensated"}});
      }
      if (unit && unit->kind == UnitKind::other) {
        leave_out(k, fmt::format("not used: in {}", unit->name));
      } else {
        lengths.push_back(k);
      }
    }
    if (lengths.empty()) return refuse(m_targets.front(), "no unit of length", known_length_units);
    const std::size_t chosen = lengths.front();
    const auto& unit = name(chosen).unit ? name(chosen).unit : m_units.target;
    if (!unit) return refuse(chosen, "no unit", known_length_units);
    m_plan.target = {chosen, name(chosen).scale.value_or(unit->mm), name(chosen).offset.value_or(0.0), true, {}, {}};
    for (std::size_t i = 1; i < lengths.size(); ++i) ZD_CHECK(check_same_target(lengths[i]));
    return {};
  }

  Status check_same_target(std::size_t other) {
    const auto& unit = name(other).unit ? name(other).unit : m_units.target;
    const double mm = unit ? unit->mm : m_plan.target.scale;
    for (const std::size_t row : m_block.rows) {
      const auto one = m_file.number(row, m_plan.target.at);
      const auto two = m_file.number(row, other);
      if (!one || !two) continue;
      constexpr double rounding_mm = 1e-3;
      if (std::abs(*one * m_plan.target.scale - *two * mm) < rounding_mm) continue;
      return unclear(m_file.file, m_file.cells.line(row), label(other),
                     fmt::format("{} beside {} in {}", m_file.cells.at(row, other),
                                 m_file.cells.at(row, m_plan.target.at), label(m_plan.target.at)),
                     "one column of targets");
    }
    leave_out(other, fmt::format("not used: the same as {}", label(m_plan.target.at)));
    return {};
  }

  /// Errors named by direction or run alone: positions where they follow the targets, else errors.
  bool follows_target(std::size_t column) const {
    double range = 0.0;
    double apart = 0.0;
    std::optional<double> first;
    for (const std::size_t row : m_block.rows) {
      const auto target = m_file.number(row, m_plan.target.at);
      const auto value = m_file.number(row, column);
      if (!target || !value) continue;
      if (!first) first = *target;
      range = std::max(range, std::abs(*target - *first));
      apart = std::max(apart, std::abs(*value - *target));
    }
    return apart < 0.01 * range;
  }

  Result<PlannedColumn> reading(std::size_t column, bool measured) const {
    PlannedColumn out;
    out.at = column;
    out.approach = name(column).approach;
    out.run = name(column).run;
    out.measured = measured;
    auto unit = name(column).unit;
    if (!unit) unit = measured ? m_units.target : m_units.error;
    if (!unit) return refuse(column, "no unit", known_length_units);
    if (unit->kind != UnitKind::length)
      return refuse(column, fmt::format("the unit {}", unit->name), known_length_units);
    out.scale = name(column).scale.value_or(measured ? unit->mm : um_per_mm * unit->mm);
    out.offset = name(column).offset.value_or(0.0);
    if (name(column).negated) out.scale = -out.scale;
    return out;
  }

  /// Of error columns those with a unit of length, when there is one at all.
  void leave_out_other_units(Indices& columns) {
    const auto is_other = [&](std::size_t k) { return name(k).unit && name(k).unit->kind != UnitKind::length; };
    const bool some = std::any_of(m_errors.begin(), m_errors.end(), [&](auto k) { return !is_other(k); }) ||
                      std::any_of(m_measured.begin(), m_measured.end(), [&](auto k) { return !is_other(k); });
    if (!some) return;
    std::erase_if(columns, [&](std::size_t k) {
      if (!is_other(k)) return false;
      leave_out(k, fmt::format("not used: in {}", name(k).unit->name));
      return true;
    });
  }

  void leave_out_empty(Indices& columns) {
    std::erase_if(columns, [&](std::size_t k) {
      if (!filled_cells(k).empty()) return false;
      leave_out(k, "not used: empty");
      return true;
    });
  }

  Status choose_values() {
    for (Indices* columns : {&m_errors, &m_measured}) {
      leave_out_empty(*columns);
      leave_out_other_units(*columns);
    }
    Indices errors;
    for (const std::size_t k : m_errors) (name(k).value && follows_target(k) ? m_measured : errors).push_back(k);
    m_errors = errors;
    const auto rotary = std::find_if(m_errors.begin(), m_errors.end(), [&](std::size_t k) {
      return name(k).unit && name(k).unit->kind == UnitKind::angle;
    });
    if (rotary != m_errors.end()) {
      return fail(
          ErrorCode::wrong_format,
          {{"file", m_file.file},
           {"found", fmt::format("of a rotary axis (column {} is in {})", label(*rotary), name(*rotary).unit->name)},
           {"expected", "positions of a linear axis; rotary axes are not compensated"}});
    }
    const auto single = [&](std::size_t k) { return !name(k).mean && !name(k).both_directions; };
    const bool singles = std::any_of(m_errors.begin(), m_errors.end(), single) ||
                         std::any_of(m_measured.begin(), m_measured.end(), single);
    for (Indices* columns : {&m_errors, &m_measured}) {
      std::erase_if(*columns, [&](std::size_t k) {
        if (!singles || single(k)) return false;
        leave_out(k, "not used: a mean of other columns");
        return true;
      });
    }
    if (m_errors.empty() && m_measured.empty()) return no_reading();
    for (const std::size_t k : m_compensations) leave_out(k, "not used: a compensation beside the readings");
    for (const std::size_t k : m_errors) ZD_CHECK(add_value(k, false));
    for (const std::size_t k : m_measured) ZD_CHECK(add_value(k, true));
    m_plan.mean_of_both = std::any_of(m_plan.values.begin(), m_plan.values.end(),
                                      [&](const auto& one) { return name(one.at).both_directions; });
    return {};
  }

  Status no_reading() {
    if (!m_compensations.empty()) {
      return refuse(m_compensations.front(), "compensation values, whose sign makers do not agree on",
                    "errors, or a column map that makes them errors (scale -1)");
    }
    return refuse(m_plan.target.at, "no column of readings beside it", expected_forms);
  }

  /// The same reading a second time, in another unit or as a position, is compared and not counted.
  Status add_value(std::size_t column, bool measured) {
    ZD_TRY(const PlannedColumn one, reading(column, measured));
    const auto before = std::find_if(m_plan.values.begin(), m_plan.values.end(), [&](const PlannedColumn& other) {
      return other.approach == one.approach && other.run == one.run;
    });
    if (before == m_plan.values.end()) {
      m_plan.values.push_back(one);
      return {};
    }
    m_plan.same.push_back(one);
    leave_out(column, fmt::format("the same reading as {}, compared with it", label(before->at)));
    return {};
  }

  /// Columns of directions beside some without, or several runs of no direction: which way is not said.
  Status check_directions() const {
    const auto& values = m_plan.values;
    const auto directed =
        std::count_if(values.begin(), values.end(), [](const auto& one) { return one.approach.has_value(); });
    const bool table_says = m_plan.direction.has_value() || direction_of_table().has_value();
    for (const PlannedColumn& one : values) {
      if (one.approach && m_plan.direction) {
        return refuse(one.at, fmt::format("a direction beside the column {}", label(*m_plan.direction)), "one of them");
      }
      if (one.run && (m_plan.run || mixed_runs(one))) {
        return refuse(one.at, fmt::format("run {} beside readings of other runs", *one.run), "one way to say the run");
      }
      const bool open = !one.approach && (directed > 0 || (values.size() > 1 && !table_says));
      if (open) return refuse(one.at, "no direction", "a name that says the direction of its runs, as others have");
    }
    return {};
  }

  /// Another column of that direction says no run.
  bool mixed_runs(const PlannedColumn& one) const {
    return std::any_of(m_plan.values.begin(), m_plan.values.end(),
                       [&](const PlannedColumn& other) { return other.approach == one.approach && !other.run; });
  }

  /// A title such as "Direction: forward", or a header inherited beside a line "Rückwärts".
  std::optional<Approach> direction_of_table() const {
    for (auto title = m_block.titles.rbegin(); title != m_block.titles.rend(); ++title) {
      if (means_both_directions(*title)) continue;
      const std::string text = normalised(*title);
      const bool about_direction = text.find("direction") != std::string::npos ||
                                   text.find("richtung") != std::string::npos ||
                                   text.find("approach") != std::string::npos || text.find("方向") != std::string::npos;
      if (!about_direction && !direction_word(*title) && !run_in_name(*title)) continue;
      if (const auto approach = direction_in_name(*title)) return approach;
    }
    return std::nullopt;
  }
  std::optional<int> run_of_table() const {
    for (auto title = m_block.titles.rbegin(); title != m_block.titles.rend(); ++title) {
      const std::string text = normalised(*title);
      const bool about_run = text.find("run") != std::string::npos || text.find("lauf") != std::string::npos ||
                             text.find("cycle") != std::string::npos || text.find("zyklus") != std::string::npos ||
                             text.find("次") != std::string::npos;
      if (about_run) {
        if (const auto run = run_in_name(text)) return run;
      }
    }
    return std::nullopt;
  }

  static constexpr const char* expected_forms =
      "position_mm,error_um or target_mm,measured_mm or target_mm,direction,run,measured_mm";

  const LaserBlock& m_block;
  const LaserCells& m_file;
  std::vector<ColumnFate>& m_fates;
  TitleUnits m_units;
  TablePlan m_plan;
  Indices m_targets, m_measured, m_errors, m_compensations;
};

}  // namespace

Result<TablePlan> plan_of(const LaserBlock& block, const LaserCells& file, std::vector<ColumnFate>& fates) {
  if (block.columns.empty()) {
    return unclear(file.file, file.cells.line(block.rows.front()), "#1", "no names above the numbers",
                   "a header that names positions and errors with their units");
  }
  return Planner(block, file, fates).plan();
}

std::string label_of(const LaserBlock& block, std::size_t column) {
  const std::string& text = block.columns.empty() ? std::string() : block.columns[column].text;
  return text.empty() ? fmt::format("#{}", column + 1) : text;
}

}  // namespace zerodrift::compensation::laser_parts
