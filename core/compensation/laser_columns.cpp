#include "core/compensation/laser_columns.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "core/compensation/laser_parts.h"

namespace zerodrift::compensation {
namespace {

using laser_parts::cells_of_line;
using laser_parts::lowered;
using laser_parts::number_in_cell;

constexpr std::array<std::string_view, 10> column_names = {"ignored",    "position", "error",       "error_up",
                                                           "error_down", "measured", "measured_up", "measured_down",
                                                           "direction",  "run"};
constexpr std::size_t lines_looked_at = 400;
constexpr std::size_t rows_shown = 12;

bool holds(std::string_view text, std::initializer_list<std::string_view> parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return text.find(part) != std::string_view::npos; });
}

/// The table of numbers in a file: how its cells are parted, and where it begins.
struct Body {
  char separator = ',';
  bool decimal_comma = false;
  std::size_t first = 0;  // index into the lines
  std::size_t columns = 0;
  std::size_t rows = 0;
};

std::size_t numbers_in(const std::vector<std::string>& cells, bool decimal_comma) {
  return static_cast<std::size_t>(std::count_if(
      cells.begin(), cells.end(), [&](const auto& cell) { return number_in_cell(cell, decimal_comma).has_value(); }));
}

/// The longest stretch of lines with the same number of cells, two of them numbers at least.
Body longest_body(const std::vector<laser_parts::Line>& lines, char separator, bool decimal_comma) {
  Body best;
  Body now;
  const auto close = [&] {
    if (now.rows > best.rows) best = now;
    now = {};
  };
  for (std::size_t i = 0; i < std::min(lines.size(), lines_looked_at); ++i) {
    if (lines[i].text.empty()) continue;
    const auto cells = cells_of_line(lines[i].text, separator);
    const bool row = cells.size() >= 2 && numbers_in(cells, decimal_comma) >= 2;
    if (row && now.rows > 0 && cells.size() != now.columns) close();
    if (!row) {
      close();
      continue;
    }
    if (now.rows == 0) now = {separator, decimal_comma, i, cells.size(), 0};
    ++now.rows;
  }
  close();
  return best;
}

Body body_of(const std::vector<laser_parts::Line>& lines) {
  Body best;
  for (const char separator : {'\t', ';', ',', '|', ' '}) {
    for (const bool decimal_comma : {false, true}) {
      if (separator == ',' && decimal_comma) continue;
      const Body one = longest_body(lines, separator, decimal_comma);
      if (one.rows > best.rows) best = one;
    }
  }
  return best;
}

struct Column {
  std::string name;  // lower case
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

LaserColumn role_by_name(const std::string& name) {
  if (name.empty()) return LaserColumn::ignored;
  if (holds(name, {"direction", "approach", "richtung", "方向"})) return LaserColumn::direction;
  if (name == "run" || holds(name, {"cycle", "zyklus", "测量次数", "循环"})) return LaserColumn::run;
  const bool down =
      holds(name, {"down", "reverse", "rev", "bwd", "backward", "negative", "rückw", "反向", "负向", "↓", "-)"});
  const bool up = !down && holds(name, {"up", "forward", "fwd", "positive", "vorw", "正向", "↑", "+)"});
  if (holds(name, {"error", "deviation", "err", "dev", "abweich", "fehler", "误差", "偏差", "combined"})) {
    return down ? LaserColumn::error_down : up ? LaserColumn::error_up : LaserColumn::error;
  }
  if (holds(name, {"measured", "actual", "reference", "istwert", "ist-", "reading", "laser", "实际", "测量"})) {
    return down ? LaserColumn::measured_down : up ? LaserColumn::measured_up : LaserColumn::measured;
  }
  if (holds(name, {"position", "target", "nominal", "command", "soll", "pos", "目标", "位置", "指令"})) {
    return LaserColumn::position;
  }
  if (down) return LaserColumn::error_down;
  return up ? LaserColumn::error_up : LaserColumn::ignored;
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

void guess_units(const std::vector<Column>& columns, LaserMapping& mapping) {
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const std::string& name = columns[i].name;
    const bool micro = holds(name, {"um", "µm", "μm", "micro", "微米"});
    const bool inch = holds(name, {"inch", "(in)", "[in]"});
    const bool milli = !micro && holds(name, {"mm", "milli", "毫米"});
    if (mapping.columns[i] == LaserColumn::position) mapping.mm_per_position = inch ? 25.4 : micro ? 1e-3 : 1.0;
    if (!is_error(mapping.columns[i])) continue;
    // Without a word: no laser report has errors below half a micrometre throughout, nor above half a millimetre.
    const bool small = columns[i].largest() < 0.5;
    mapping.um_per_error = micro ? 1.0 : inch ? 25400.0 : milli || small ? 1000.0 : 1.0;
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

std::string encoding_of(std::string_view bytes) {
  if (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF")) return "UTF-16";
  const std::string text = to_utf8(bytes);
  const std::string_view plain = bytes.starts_with("\xEF\xBB\xBF") ? bytes.substr(3) : bytes;
  return text == plain ? "UTF-8" : "GBK";
}

}  // namespace

std::string_view name_of(LaserColumn column) {
  return column_names.at(static_cast<std::size_t>(column));
}

Result<LaserPreview> preview_laser(std::string_view bytes, const std::string& file) {
  const std::string text = to_utf8(bytes);
  const auto lines = laser_parts::lines_of(text);
  const Body body = body_of(lines);
  if (body.rows < 2) {
    return fail(ErrorCode::not_enough_data,
                {{"what", "rows of numbers in " + file}, {"found", std::to_string(body.rows)}, {"needed", "2"}});
  }
  LaserPreview preview;
  preview.encoding = encoding_of(bytes);
  preview.names.resize(body.columns);
  if (body.first > 0) {
    std::size_t above = body.first;
    while (above > 0 && lines[above - 1].text.empty()) --above;
    const auto names = above == 0 ? std::vector<std::string>{} : cells_of_line(lines[above - 1].text, body.separator);
    if (names.size() == body.columns) preview.names = names;
  }
  std::vector<Column> columns(body.columns);
  for (std::size_t i = 0; i < body.columns; ++i) columns[i].name = lowered(preview.names[i]);
  std::size_t taken = 0;
  for (std::size_t i = body.first; i < lines.size() && taken < body.rows; ++i) {
    if (lines[i].text.empty()) continue;
    ++taken;
    const auto cells = cells_of_line(lines[i].text, body.separator);
    if (preview.rows.size() < rows_shown) preview.rows.push_back(cells);
    for (std::size_t k = 0; k < cells.size(); ++k) {
      if (const auto value = number_in_cell(cells[k], body.decimal_comma)) columns[k].values.push_back(*value);
    }
  }
  LaserMapping& mapping = preview.guess;
  mapping.separator = body.separator;
  mapping.decimal_comma = body.decimal_comma;
  mapping.first_line = lines[body.first].number;
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
