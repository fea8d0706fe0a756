// Readings of a table whose columns the user has settled.

#include <fmt/format.h>

#include <algorithm>

#include "core/compensation/laser_rows.h"
#include "core/recording/import/text_table.h"

namespace zerodrift::compensation::laser_parts {
namespace {

std::string separator_name(char separator) {
  return separator == '\t' ? "tab" : separator == ' ' ? "blanks" : std::string(1, separator);
}

/// The rows from the first one of numbers on; the table ends where lines of other kinds begin.
Result<LaserBlock> settled_block(const recording::Cells& cells, const recording::NumberFormat& numbers,
                                 const LaserMapping& mapping, std::size_t position, const std::string& file) {
  LaserBlock block;
  block.width = mapping.columns.size();
  for (const LaserColumn role : mapping.columns) block.columns.push_back(column_name(name_of(role)));
  for (std::size_t row = 0; row < cells.rows(); ++row) {
    if (cells.line(row) < mapping.first_line || cells.is_blank(row) || cells.is_comment(row)) continue;
    if (!numbers.number(cells.at(row, position))) {
      if (cells.columns(row) != block.width && !block.rows.empty()) break;
      const std::vector<std::string> found = cells.row(row);
      return fail(ErrorCode::csv_bad_number, {{"file", file},
                                              {"line", std::to_string(cells.line(row))},
                                              {"column", "position"},
                                              {"found", found.empty() ? std::string() : found[0].substr(0, 60)}});
    }
    block.rows.push_back(row);
  }
  return block;
}

TablePlan settled_plan(const LaserMapping& mapping, std::size_t position) {
  TablePlan plan;
  plan.target = {position, mapping.mm_per_position, 0.0, true, {}, {}};
  plan.direction_from_order = mapping.direction_from_order;
  for (std::size_t k = 0; k < mapping.columns.size(); ++k) {
    const LaserColumn role = mapping.columns[k];
    if (role == LaserColumn::direction) plan.direction = k;
    if (role == LaserColumn::run) plan.run = k;
    if (!is_error(role) && !is_measured(role)) continue;
    PlannedColumn one;
    one.at = k;
    one.measured = is_measured(role);
    one.scale = one.measured ? mapping.mm_per_position : (mapping.negated ? -1.0 : 1.0) * mapping.um_per_error;
    if (role == LaserColumn::error_up || role == LaserColumn::measured_up) one.approach = Approach::up;
    if (role == LaserColumn::error_down || role == LaserColumn::measured_down) one.approach = Approach::down;
    // Several columns of one direction are its runs; an error beside a measured position is the same reading again.
    const auto alike = [&](const PlannedColumn& other) { return other.approach == one.approach; };
    const auto before = std::find_if(plan.values.begin(), plan.values.end(), alike);
    const bool again = before != plan.values.end() && before->measured != one.measured;
    (again ? plan.same : plan.values).push_back(one);
  }
  return plan;
}

}  // namespace

Result<LaserReport> parse_mapped(std::string_view bytes, const std::string& file, const LaserMapping& mapping,
                                 const LaserOptions& options) {
  const auto at = std::find(mapping.columns.begin(), mapping.columns.end(), LaserColumn::position);
  if (at == mapping.columns.end()) {
    return fail(
        ErrorCode::bad_argument,
        {{"what", "the columns of " + file}, {"found", "no position"}, {"expected", "one column of positions"}});
  }
  const auto position = static_cast<std::size_t>(at - mapping.columns.begin());
  recording::TableOptions form;
  if (!bytes.starts_with("PK")) form.separator = separator_name(mapping.separator);
  ZD_TRY(const recording::SourceCells source, recording::parse_cells(bytes, file, form));
  const recording::NumberFormat numbers{mapping.decimal_comma ? ',' : '.', true};
  ZD_TRY(LaserBlock block, settled_block(source.cells, numbers, mapping, position, file));
  const LaserCells cells{source.cells, numbers, file};
  ZD_TRY(const ReadRows rows, read_rows({{std::move(block), settled_plan(mapping, position)}}, cells, options));
  ZD_TRY(LaserReport report, assemble(rows.readings, file, options));
  report.warnings.push_back(fmt::format("{}: read as: {}; confirm the sign on one point", file, describe(mapping)));
  return report;
}

}  // namespace zerodrift::compensation::laser_parts
