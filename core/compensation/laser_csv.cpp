// The contract's CSV forms: position_mm,error_um; target_mm,measured_mm; target_mm,direction,run,measured_mm.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "core/compensation/laser_parts.h"
#include "core/recording/csv.h"

namespace zerodrift::compensation::laser_parts {
namespace {

using recording::TextTable;

struct Columns {
  int target = -1;
  int error = -1;
  int measured = -1;
  int direction = -1;
  int run = -1;
  int axis = -1;
};

int first_column(const TextTable& table, const std::vector<const char*>& names) {
  for (const char* name : names) {
    if (const int at = table.column(name); at >= 0) return at;
  }
  return -1;
}

Result<Columns> columns_of(const TextTable& table) {
  Columns columns;
  columns.target = first_column(table, {"position_mm", "target_mm"});
  columns.error = first_column(table, {"error_um", "deviation_um"});
  columns.measured = first_column(table, {"measured_mm", "reference_mm"});
  columns.direction = table.column("direction");
  columns.run = first_column(table, {"run", "cycle"});
  columns.axis = table.column("axis");
  if (columns.target >= 0 && (columns.error >= 0 || columns.measured >= 0)) return columns;
  std::string found;
  for (const auto& name : table.header) found += (found.empty() ? "" : ",") + name;
  return fail(ErrorCode::csv_bad_header,
              {{"file", table.file},
               {"column", columns.target < 0 ? "position_mm" : "error_um"},
               {"found", found},
               {"expected", "position_mm,error_um or target_mm,measured_mm or target_mm,direction,run,measured_mm"}});
}

tl::unexpected<Error> bad_cell(const TextTable& table, std::size_t row, int column) {
  return fail(ErrorCode::csv_bad_number, {{"file", table.file},
                                          {"line", std::to_string(table.lines[row])},
                                          {"column", table.header[static_cast<std::size_t>(column)]},
                                          {"found", table.rows[row][static_cast<std::size_t>(column)]}});
}

Result<Approach> approach_from(const TextTable& table, std::size_t row, int column) {
  if (const auto approach = approach_word(table.rows[row][static_cast<std::size_t>(column)])) return *approach;
  return bad_cell(table, row, column);
}

Result<double> cell(const TextTable& table, std::size_t row, int column) {
  ZD_TRY(const double value, recording::number_in(table, row, column));
  if (std::isfinite(value)) return value;
  return bad_cell(table, row, column);
}

Result<RawReading> reading_at(const TextTable& table, std::size_t row, const Columns& columns) {
  RawReading one;
  ZD_TRY(one.target_mm, cell(table, row, columns.target));
  if (columns.error >= 0) {
    ZD_TRY(one.deviation_um, cell(table, row, columns.error));
  } else {
    ZD_TRY(const double measured_mm, cell(table, row, columns.measured));
    one.deviation_um = 1000.0 * (measured_mm - one.target_mm);
  }
  if (columns.direction >= 0) {
    ZD_TRY(one.approach, approach_from(table, row, columns.direction));
  }
  if (columns.run >= 0) {
    ZD_TRY(const double number, cell(table, row, columns.run));
    const auto run = run_number(number);
    if (!run) return bad_cell(table, row, columns.run);
    one.run = *run;
  }
  return one;
}

struct Axes {
  std::vector<std::string> all;
  std::string chosen;  // empty: the file names none
};

/// A file with several axes gives the one asked for.
Result<Axes> axes_of(const TextTable& table, const Columns& columns, const LaserOptions& options) {
  Axes axes;
  if (columns.axis < 0) return axes;
  for (const auto& row : table.rows) {
    const auto& name = row[static_cast<std::size_t>(columns.axis)];
    if (std::find(axes.all.begin(), axes.all.end(), name) == axes.all.end()) axes.all.push_back(name);
  }
  axes.chosen = axes.all.front();
  if (axes.all.size() == 1) return axes;
  const auto wanted = std::find_if(axes.all.begin(), axes.all.end(),
                                   [&](const auto& name) { return lowered(name) == lowered(options.axis); });
  if (wanted == axes.all.end()) {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the axes in " + table.file},
                 {"found", fmt::format("{}", fmt::join(axes.all, ", "))},
                 {"expected", options.axis.empty() ? "one, or the choice of one of them" : "axis " + options.axis}});
  }
  axes.chosen = *wanted;
  return axes;
}

}  // namespace

Result<LaserReport> parse_csv(std::string_view text, const std::string& file, const LaserOptions& options) {
  ZD_TRY(TextTable table, recording::parse_table(text, file));
  for (auto& name : table.header) {
    if (const auto mapped = options.columns.find(name); mapped != options.columns.end()) name = mapped->second;
  }
  ZD_TRY(const Columns columns, columns_of(table));
  ZD_TRY(const Axes axes, axes_of(table, columns, options));
  std::vector<RawReading> readings;
  std::map<std::pair<double, int>, int> seen;  // target and direction -> readings so far, when no run is given
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    if (!axes.chosen.empty() && table.rows[row][static_cast<std::size_t>(columns.axis)] != axes.chosen) continue;
    ZD_TRY(RawReading one, reading_at(table, row, columns));
    if (columns.run < 0) one.run = ++seen[{one.target_mm, one.approach == Approach::up ? 0 : 1}];
    readings.push_back(one);
  }
  ZD_TRY(LaserReport report, assemble(readings, file, options));
  report.axis = axes.chosen;
  report.axes = axes.all;
  return report;
}

}  // namespace zerodrift::compensation::laser_parts
