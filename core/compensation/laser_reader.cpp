// Tables of positions and errors in the contract's forms and in those of other makers.

#include <fmt/format.h>

#include <algorithm>

#include "core/compensation/laser_rows.h"
#include "core/recording/import/text_table.h"

namespace zerodrift::compensation::laser_parts {
namespace {

using recording::HeaderMap;
using recording::NumberEvidence;
using recording::SourceCells;

/// Names that the user gave, in the place of those in the file.
Status rename(LaserBlock& block, const LaserOptions& options) {
  if (block.columns.empty() && options.map) block.columns.resize(block.width);
  for (std::size_t k = 0; k < block.columns.size(); ++k) {
    ColumnName& column = block.columns[k];
    const std::string text = column.text;
    if (const auto other = options.columns.find(text); other != options.columns.end()) {
      column = column_name(other->second);
      column.text = text;
    }
    const auto* rule = options.map ? options.map->rule_for(text, {}, k) : nullptr;
    if (rule == nullptr) continue;
    if (!*rule) {
      column = ColumnName{};
      column.text = text;
      column.role = ColumnRole::remark;
      continue;
    }
    const std::optional<Unit> unit_in_file = column.unit;
    column = column_name((*rule)->channel);
    column.text = text;
    if (column.role == ColumnRole::unknown || column.value) {
      return fail(ErrorCode::bad_argument,
                  {{"what", fmt::format("the channel of the column {}", text)},
                   {"found", (*rule)->channel},
                   {"expected", "position_mm, error_um, measured_mm, direction, run or axis"}});
    }
    column.scale = (*rule)->scale;
    column.offset = (*rule)->offset;
    if (column.scale) continue;  // into the channel's own unit
    const auto unit = (*rule)->unit.empty() ? unit_in_file : unit_of((*rule)->unit);
    if (!(*rule)->unit.empty() && !unit) {
      return fail(ErrorCode::bad_argument, {{"what", fmt::format("the unit of the column {}", text)},
                                            {"found", (*rule)->unit},
                                            {"expected", "a unit of length: mm, um, in, uin, mil"}});
    }
    if (unit) column.unit = unit;
  }
  return {};
}

struct Tables {
  SourceCells source;
  std::vector<LaserBlock> blocks;
};

bool has_names(const LaserBlock& block) {
  const auto has = [&](auto accept) { return std::any_of(block.columns.begin(), block.columns.end(), accept); };
  return has([](const ColumnName& one) { return one.role == ColumnRole::target; }) &&
         has([](const ColumnName& one) { return one.role == ColumnRole::error || one.role == ColumnRole::measured; });
}

/// With the separator that the numbers suggest; else with the first under which a header names positions and readings.
Result<Tables> tables_in(std::string_view bytes, const std::string& file, recording::TableOptions form) {
  const bool settled = !form.separator.empty() || bytes.starts_with("PK");
  std::optional<Result<Tables>> first;
  for (const char* separator : {"", ";", "tab", ",", "|", "blanks"}) {
    if (*separator != '\0') form.separator = separator;
    auto source = recording::parse_cells(bytes, file, form);
    Result<std::vector<LaserBlock>> blocks = fail(ErrorCode::internal);
    if (source) {
      blocks = blocks_of(source->cells, file);
    } else {
      blocks = fail(source.error());
    }
    const bool named = blocks && std::any_of(blocks->begin(), blocks->end(), has_names);
    Result<Tables> found =
        blocks ? Result<Tables>(Tables{std::move(*source), std::move(*blocks)}) : fail(blocks.error());
    if (named || settled) return found;
    if (!first) first = std::move(found);
  }
  return std::move(*first);
}

/// One number format for the file: from all cells of its tables.
Result<recording::NumberFormat> numbers_of(const std::vector<LaserBlock>& blocks, const SourceCells& source,
                                           const LaserOptions& options) {
  if (options.map && !options.map->table.decimal.empty()) {
    return recording::NumberFormat{options.map->table.decimal.front(), true};
  }
  NumberEvidence evidence;
  for (const LaserBlock& block : blocks) {
    for (const std::size_t row : block.rows) {
      for (std::size_t k = 0; k < block.width; ++k) {
        const std::string_view cell = source.cells.at(row, k);
        evidence.add(cell, [&] {
          return NumberEvidence::Place{std::string(cell), source.cells.line(row), label_of(block, k)};
        });
      }
    }
  }
  return evidence.decide(source.form.file);
}

/// A table without positions or readings beside one that has them is no part of the report.
bool is_another_table(const Error& error, const LaserBlock& block) {
  return error.code == ErrorCode::csv_bad_header || (error.code == ErrorCode::column_unclear && block.columns.empty());
}

bool has_direction(const PlannedTable& table) {
  const auto& values = table.plan.values;
  return table.plan.approach || table.plan.direction ||
         std::any_of(values.begin(), values.end(), [](const auto& one) { return one.approach.has_value(); });
}

std::string table_at(const LaserBlock& block, const recording::Cells& cells) {
  return fmt::format("table at line {}",
                     block.header_line > 0 && !block.inherited ? block.header_line : cells.line(block.rows.front()));
}

/// Means of both directions say nothing that tables of each direction do not say.
void leave_out_means(std::vector<PlannedTable>& tables, const recording::Cells& cells, std::vector<ColumnFate>& fates) {
  if (std::none_of(tables.begin(), tables.end(), has_direction)) return;
  std::erase_if(tables, [&](const PlannedTable& table) {
    if (!table.plan.mean_of_both || has_direction(table)) return false;
    fates.push_back({table_at(table.block, cells), "not used: means of both directions"});
    return true;
  });
}

/// Several tables: each says its direction, or its run.
Status check_tables(const std::vector<PlannedTable>& tables, const LaserCells& file) {
  if (tables.size() < 2) return {};
  const bool axes =
      std::all_of(tables.begin(), tables.end(), [](const auto& one) { return one.plan.axis.has_value(); });
  const bool any = std::any_of(tables.begin(), tables.end(), has_direction);
  for (const PlannedTable& table : tables) {
    const bool clear = has_direction(table) || (!any && (table.plan.table_run || axes));
    if (clear) continue;
    return unclear(file.file, file.cells.line(table.block.rows.front()), label_of(table.block, table.plan.target.at),
                   "another table, with no direction above it", "a line above each table that says its direction");
  }
  return {};
}

std::string unit_name(const PlannedTable& table, const PlannedColumn& column) {
  const auto& unit = table.block.columns[column.at].unit;
  return unit ? unit->name : std::string(column.measured ? "mm" : "um");
}

std::string fate_of(const PlannedTable& table, const PlannedColumn& column, const char* what) {
  std::string fate = fmt::format("{} in {}", what, unit_name(table, column));
  if (column.approach) fate += *column.approach == Approach::up ? ", upwards" : ", downwards";
  if (column.run) fate += fmt::format(", run {}", *column.run);
  return fate;
}

/// Of the columns that are read.
std::vector<ColumnFate> fates_of(const PlannedTable& table) {
  std::vector<ColumnFate> fates;
  const auto put = [&](std::size_t column, const std::string& fate) {
    fates.push_back({label_of(table.block, column), fate});
  };
  put(table.plan.target.at, fate_of(table, table.plan.target, "position"));
  for (const PlannedColumn& value : table.plan.values) {
    put(value.at, fate_of(table, value, value.measured ? "measured position" : "error"));
  }
  if (table.plan.direction) put(*table.plan.direction, "direction");
  if (table.plan.run) put(*table.plan.run, "run");
  if (table.plan.axis) put(*table.plan.axis, "axis");
  return fates;
}

bool has_contract_names(const LaserBlock& block) {
  static const std::vector<std::string> names = {"position_mm",  "target_mm", "error_um", "deviation_um", "measured_mm",
                                                 "reference_mm", "direction", "run",      "cycle",        "axis"};
  return std::all_of(block.columns.begin(), block.columns.end(), [&](const ColumnName& column) {
    return std::find(names.begin(), names.end(), column.text) != names.end();
  });
}

void tell(const std::vector<PlannedTable>& tables, bool from_order, LaserReport& report) {
  const bool by_contract = std::all_of(tables.begin(), tables.end(),
                                       [](const PlannedTable& table) { return has_contract_names(table.block); });
  std::vector<ColumnFate> read;
  for (const PlannedTable& table : tables) {
    for (ColumnFate& fate : fates_of(table)) {
      const auto again = std::find_if(read.begin(), read.end(), [&](const ColumnFate& one) {
        return one.column == fate.column && one.fate == fate.fate;
      });
      if (again == read.end()) read.push_back(std::move(fate));
    }
  }
  const std::vector<ColumnFate> unread = std::move(report.columns);
  report.columns = read;
  report.columns.insert(report.columns.end(), unread.begin(), unread.end());
  if (from_order) report.warnings.push_back(fmt::format("{}: the order of the rows tells the direction", report.file));
  if (std::any_of(tables.begin(), tables.end(), [](const auto& one) { return one.plan.mean_of_both; })) {
    report.warnings.push_back(
        fmt::format("{}: means of both directions; the file says nothing of backlash", report.file));
  }
  if (by_contract && unread.empty()) return;
  for (const ColumnFate& fate : report.columns) {
    report.warnings.push_back(fmt::format("{}: column {}: {}", report.file, fate.column, fate.fate));
  }
}

}  // namespace

Result<LaserReport> parse_tables(std::string_view bytes, const std::string& file, const LaserOptions& options) {
  ZD_TRY(Tables found, tables_in(bytes, file, options.map ? options.map->table : recording::TableOptions{}));
  const SourceCells& source = found.source;
  std::vector<LaserBlock>& blocks = found.blocks;
  if (blocks.empty()) {
    return fail(ErrorCode::not_enough_data, {{"what", "rows of numbers in " + file}, {"found", "0"}, {"needed", "2"}});
  }
  for (LaserBlock& block : blocks) ZD_CHECK(rename(block, options));
  ZD_TRY(const recording::NumberFormat numbers, numbers_of(blocks, source, options));
  const LaserCells cells{source.cells, numbers, file};
  LaserReport told;
  std::vector<PlannedTable> tables;
  std::optional<Error> first_error;
  for (LaserBlock& block : blocks) {
    std::vector<ColumnFate> fates;
    auto plan = plan_of(block, cells, fates);
    if (!plan && !is_another_table(plan.error(), block)) return fail(plan.error());
    if (!plan) {
      if (!first_error) first_error = plan.error();
      told.columns.push_back({table_at(block, source.cells), "not used: no positions with errors"});
      continue;
    }
    for (ColumnFate& fate : fates) {
      const bool known = std::any_of(told.columns.begin(), told.columns.end(),
                                     [&](const ColumnFate& one) { return one.column == fate.column; });
      if (!known) told.columns.push_back(std::move(fate));
    }
    tables.push_back({std::move(block), std::move(*plan)});
  }
  if (tables.empty()) return fail(*first_error);
  leave_out_means(tables, source.cells, told.columns);
  ZD_CHECK(check_tables(tables, cells));
  ZD_TRY(const ReadRows rows, read_rows(tables, cells, options));
  ZD_TRY(LaserReport report, assemble(rows.readings, file, options));
  report.axis = rows.axis;
  report.axes = rows.axes;
  report.columns = std::move(told.columns);
  tell(tables, rows.from_order, report);
  return report;
}

}  // namespace zerodrift::compensation::laser_parts
