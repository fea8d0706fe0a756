#include "core/compensation/laser_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/compensation/laser_parts.h"
#include "core/compensation/laser_table.h"
#include "core/recording/import/number_format.h"
#include "core/recording/import/text_table.h"

namespace zerodrift::compensation {
namespace {

using laser_parts::ColumnName;
using laser_parts::ColumnRole;
using laser_parts::LaserBlock;
using laser_parts::UnitKind;

constexpr std::array<std::string_view, 10> column_names = {"ignored",    "position", "error",       "error_up",
                                                           "error_down", "measured", "measured_up", "measured_down",
                                                           "direction",  "run"};
constexpr std::size_t rows_shown = 12;

struct Column {
  ColumnName name;
  std::vector<double> values;
  bool numeric() const { return values.size() >= 2; }
  double range() const {
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return values.empty() ? 0.0 : *high - *low;
  }
  double largest() const {
    double most = 0.0;
    for (const double value : values) most = std::max(most, std::abs(value));
    return most;
  }
  bool counts() const {  // 0 1 2 3 or 1 2 3 4: a number of the row
    for (std::size_t i = 1; i < values.size(); ++i) {
      if (values[i] != values[i - 1] + 1.0) return false;
    }
    return numeric() && (values.front() == 0.0 || values.front() == 1.0);
  }
};

LaserColumn role_by_name(const ColumnName& name) {
  const bool up = name.approach == Approach::up;
  switch (name.role) {
    case ColumnRole::target:
      return LaserColumn::position;
    case ColumnRole::measured:
      return !name.approach ? LaserColumn::measured : up ? LaserColumn::measured_up : LaserColumn::measured_down;
    case ColumnRole::error:
      return !name.approach ? LaserColumn::error : up ? LaserColumn::error_up : LaserColumn::error_down;
    case ColumnRole::direction:
      return LaserColumn::direction;
    case ColumnRole::run:
      return LaserColumn::run;
    default:
      return LaserColumn::ignored;
  }
}

/// Where the names say nothing: the first column that is no row number is the position, the next one the value.
void guess_by_numbers(const std::vector<Column>& columns, LaserMapping& mapping) {
  const auto find = [&](auto accept) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (columns[i].numeric() && mapping.columns[i] == LaserColumn::ignored && accept(i)) return i;
    }
    return columns.size();
  };
  const auto has = [&](auto accept) { return std::any_of(mapping.columns.begin(), mapping.columns.end(), accept); };
  if (!has([](LaserColumn role) { return role == LaserColumn::position; })) {
    std::size_t at = find([&](std::size_t i) { return columns.size() < 3 || !columns[i].counts(); });
    if (at == columns.size()) at = find([](std::size_t) { return true; });
    if (at < columns.size()) mapping.columns[at] = LaserColumn::position;
  }
  if (has([](LaserColumn role) { return is_error(role) || is_measured(role); })) return;
  const auto position = static_cast<std::size_t>(
      std::find(mapping.columns.begin(), mapping.columns.end(), LaserColumn::position) - mapping.columns.begin());
  const std::size_t value = find([&](std::size_t i) { return i > position; });
  if (value >= columns.size() || position >= columns.size()) return;
  double apart = 0.0;
  const std::size_t rows = std::min(columns[position].values.size(), columns[value].values.size());
  for (std::size_t i = 0; i < rows; ++i) {
    apart = std::max(apart, std::abs(columns[value].values[i] - columns[position].values[i]));
  }
  // Within 1 % of the travel of the target at every row: an actual position, no error.
  const bool follows = apart < 0.01 * columns[position].range();
  mapping.columns[value] = follows ? LaserColumn::measured : LaserColumn::error;
}

/// A proposal for the user, who settles it: nothing is read with it unseen.
void guess_units(const std::vector<Column>& columns, LaserMapping& mapping) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const auto& unit = columns[i].name.unit;
    const bool length = unit && unit->kind == UnitKind::length;
    if (mapping.columns[i] == LaserColumn::position && length) mapping.mm_per_position = unit->mm;
    if (!is_error(mapping.columns[i])) continue;
    // Without a word: no laser report has errors below half a micrometre throughout, nor above half a millimetre.
    const bool small = columns[i].largest() < 0.5;
    mapping.um_per_error = length ? 1000.0 * unit->mm : small ? 1000.0 : 1.0;
  }
}

/// Targets driven there and back again, with nothing else that tells the approach.
bool turns_back(const std::vector<Column>& columns, const LaserMapping& mapping) {
  bool single = false;
  std::size_t position = columns.size();
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const LaserColumn role = mapping.columns[i];
    if (role == LaserColumn::direction || role == LaserColumn::error_down || role == LaserColumn::measured_down) {
      return false;
    }
    single = single || role == LaserColumn::error || role == LaserColumn::measured;
    if (role == LaserColumn::position) position = i;
  }
  if (!single || position == columns.size()) return false;
  const auto& x = columns[position].values;
  std::size_t falling = 0;
  std::size_t rising = 0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    falling += x[i] < x[i - 1] ? 1 : 0;
    rising += x[i] > x[i - 1] ? 1 : 0;
  }
  // One fall a pass is a run that begins anew; there and back falls as often as it rises.
  return rising > 0 && falling > 1 && 3 * falling > rising;
}

char separator_named(const std::string& name) {
  return name == "tab" ? '\t' : name == "blanks" || name.empty() ? ' ' : name.front();
}

/// As the window shows it.
std::string short_encoding(const std::string& name) {
  if (name.starts_with("UTF-16")) return "UTF-16";
  if (name.starts_with("UTF-8")) return "UTF-8";
  return name == "GB18030" ? "GBK" : name;
}

/// The decimal mark that most of the table's cells have; what contradicts it shows when it is read.
recording::NumberFormat numbers_in(const LaserBlock& block, const recording::Cells& cells) {
  recording::NumberEvidence evidence;
  for (const std::size_t row : block.rows) {
    for (std::size_t k = 0; k < block.width; ++k) {
      evidence.add(cells.at(row, k), [&] { return recording::NumberEvidence::Place{}; });
    }
  }
  const auto format = evidence.decide({});
  return format ? *format : recording::NumberFormat{};
}

}  // namespace

std::string_view name_of(LaserColumn column) {
  return column_names.at(static_cast<std::size_t>(column));
}

Result<LaserPreview> preview_laser(std::string_view bytes, const std::string& file) {
  ZD_TRY(const recording::SourceCells source, recording::parse_cells(bytes, file));
  ZD_TRY(const std::vector<LaserBlock> blocks, laser_parts::blocks_of(source.cells, file));
  const auto longest = std::max_element(blocks.begin(), blocks.end(),
                                        [](const auto& a, const auto& b) { return a.rows.size() < b.rows.size(); });
  const std::size_t found = longest == blocks.end() ? 0 : longest->rows.size();
  if (found < 2) {
    return fail(ErrorCode::not_enough_data,
                {{"what", "rows of numbers in " + file}, {"found", std::to_string(found)}, {"needed", "2"}});
  }
  const LaserBlock& block = *longest;
  const recording::NumberFormat numbers = numbers_in(block, source.cells);
  LaserPreview preview;
  preview.encoding = short_encoding(source.form.encoding);
  std::vector<Column> columns(block.width);
  for (std::size_t k = 0; k < block.width; ++k) {
    if (!block.columns.empty()) columns[k].name = block.columns[k];
    preview.names.push_back(columns[k].name.text);
  }
  for (const std::size_t row : block.rows) {
    if (preview.rows.size() < rows_shown) preview.rows.push_back(source.cells.row(row));
    for (std::size_t k = 0; k < block.width; ++k) {
      if (const auto value = numbers.number(source.cells.at(row, k))) columns[k].values.push_back(*value);
    }
  }
  LaserMapping& mapping = preview.guess;
  mapping.separator = separator_named(source.form.separator);
  mapping.decimal_comma = numbers.decimal == ',';
  mapping.first_line = source.cells.line(block.rows.front());
  bool position = false;
  bool value = false;
  for (const Column& column : columns) {
    LaserColumn role = role_by_name(column.name);
    if (role == LaserColumn::position && position) role = LaserColumn::ignored;
    position = position || role == LaserColumn::position;
    value = value || is_error(role) || is_measured(role);
    mapping.columns.push_back(role);
  }
  preview.certain = position && value;
  guess_by_numbers(columns, mapping);
  guess_units(columns, mapping);
  mapping.direction_from_order = turns_back(columns, mapping);
  return preview;
}

std::string signature_of(const LaserPreview& preview) {
  std::string out = std::to_string(preview.names.size());
  for (const auto& name : preview.names) out += "|" + name;
  return out;
}

std::string text_of(const LaserMapping& mapping) {
  std::string out = fmt::format("{} {:.17g} {:.17g} {} {} {}", static_cast<int>(mapping.separator),
                                mapping.mm_per_position, mapping.um_per_error, mapping.decimal_comma ? 1 : 0,
                                mapping.negated ? 1 : 0, mapping.direction_from_order ? 1 : 0);
  for (const LaserColumn column : mapping.columns) out += fmt::format(" {}", name_of(column));
  return out;
}

std::optional<LaserMapping> mapping_from_text(const std::string& text, std::size_t columns) {
  std::istringstream in(text);
  LaserMapping mapping;
  int separator = 0;
  int comma = 0;
  int negated = 0;
  int order = 0;
  if (!(in >> separator >> mapping.mm_per_position >> mapping.um_per_error >> comma >> negated >> order)) return {};
  if (!(mapping.mm_per_position > 0.0 && mapping.um_per_error > 0.0)) return {};
  mapping.separator = static_cast<char>(separator);
  mapping.decimal_comma = comma != 0;
  mapping.negated = negated != 0;
  mapping.direction_from_order = order != 0;
  for (std::string word; in >> word;) {
    const auto at = std::find(column_names.begin(), column_names.end(), word);
    if (at == column_names.end()) return {};
    mapping.columns.push_back(static_cast<LaserColumn>(at - column_names.begin()));
  }
  if (mapping.columns.size() != columns) return {};
  return mapping;
}

std::string describe(const LaserMapping& mapping) {
  std::string out;
  for (std::size_t i = 0; i < mapping.columns.size(); ++i) {
    const LaserColumn role = mapping.columns[i];
    if (role == LaserColumn::ignored) continue;
    std::string unit;
    if (role == LaserColumn::position || is_measured(role)) {
      unit = mapping.mm_per_position == 1.0 ? " in mm" : fmt::format(" x {:g} mm", mapping.mm_per_position);
    } else if (is_error(role)) {
      unit = mapping.um_per_error == 1.0      ? " in um"
             : mapping.um_per_error == 1000.0 ? " in mm"
                                              : fmt::format(" x {:g} um", mapping.um_per_error);
    }
    std::string word(name_of(role));
    std::replace(word.begin(), word.end(), '_', ' ');
    out += fmt::format("{}column {} is {}{}", out.empty() ? "" : ", ", i + 1, word, unit);
  }
  if (mapping.direction_from_order) out += ", the order tells the direction";
  if (mapping.negated) out += ", signs turned";
  return out;
}

}  // namespace zerodrift::compensation
