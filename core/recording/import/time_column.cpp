#include "core/recording/import/time_column.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cmath>

#include "core/recording/import/cell_words.h"
#include "core/recording/import/clock_text.h"
#include "core/recording/import/units.h"

namespace zerodrift::recording {
namespace {

constexpr std::int64_t ns_per_s = 1'000'000'000;
constexpr std::int64_t day_ns = 86400 * ns_per_s;
constexpr std::int64_t hour_ns = 3600 * ns_per_s;
constexpr std::size_t looked_at = 40;                // rows, to see what a column holds
constexpr double seconds_1904_to_1970 = 2082844800;  // LabVIEW counts from 1904-01-01

std::string in_lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return out;
}

/// What a column holds, from its first rows.
struct Contents {
  int numbers = 0;
  int dates = 0;  // with or without time of day
  int times = 0;  // of day
  int others = 0;
  bool is_date_and_time() const { return dates > 0 && times > 0 && others <= dates && numbers == 0; }
  bool is_date() const { return dates > 0 && times == 0 && others <= dates && numbers == 0; }
  bool is_time_of_day() const { return times > 0 && dates == 0 && others <= times && numbers == 0; }
  bool is_number() const { return numbers > 0 && dates == 0 && times == 0 && others == 0; }
};

Contents contents_of(const SourceTable& table, std::size_t column) {
  Contents out;
  for (std::size_t row = 0; row < std::min(table.rows.size(), looked_at); ++row) {
    const std::string_view cell = table.cell(row, column);
    if (means_missing(cell)) continue;
    if (looks_like_number(cell)) {
      ++out.numbers;
    } else if (const auto clock = read_clock_text(cell)) {
      out.dates += clock->has_date();
      // A spreadsheet gives midnight to a date alone.
      out.times += clock->has_time && !(clock->has_date() && clock->of_day_ns == 0);
    } else {
      ++out.others;
    }
  }
  return out;
}

/// The name of a column of times, its unit apart.
bool is_time_name(std::string_view header) {
  const std::string name = in_lower_case(split_unit(header).name);
  static const std::array<const char*, 23> words{"sekunden", "minuten", "stunden", "秒",      "小时",     "t",
                                                 "date",     "datum",   "uhrzeit", "x_value", "seconds",  "epoch",
                                                 "unix",     "zeit",    "hours",   "minutes", "laufzeit", "时间",
                                                 "日期",     "时刻",    "sec",     "x",       "runtime"};
  if (header == "T" || header == "X") return false;  // a temperature, an axis
  if (std::find(words.begin(), words.end(), name) != words.end()) return true;
  return name.starts_with("time") || name.starts_with("elapsed") || name.starts_with("zeit") ||
         name.starts_with("date") || name.starts_with("unix") || name.starts_with("epoch") || name.ends_with(" time") ||
         name.ends_with("_time") || name.ends_with("timestamp") || name.find("时间") != std::string::npos;
}

/// A unit of time in the units row, in the header, or as the whole name ("Seconds").
std::string time_unit_of(const SourceTable& table, std::size_t column) {
  for (const std::string& text : {table.units[column], split_unit(table.names[column]).unit, table.names[column]}) {
    const auto unit = unit_from(text);
    if (unit && unit->quantity == Quantity::time) return text;
  }
  return {};
}

std::string lineage(const SourceTable& table, std::size_t row) {
  return std::to_string(table.line(row));
}

tl::unexpected<Error> at_cell(ErrorCode code, const SourceTable& table, std::size_t row, std::size_t column) {
  return fail(code, {{"file", table.form.file},
                     {"line", lineage(table, row)},
                     {"column", table.name_of(column)},
                     {"found", shortened(std::string(table.cell(row, column)))}});
}

std::string iso_text(std::int64_t since_1970_ns, std::optional<int> zone_minutes) {
  using namespace std::chrono;
  const sys_time<nanoseconds> at{nanoseconds{since_1970_ns}};
  const auto day = floor<days>(at);
  const year_month_day date{day};
  const auto ms = duration_cast<milliseconds>(at - day).count();
  std::string text = fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}", int(date.year()), unsigned(date.month()),
                                 unsigned(date.day()), ms / 3600000, ms / 60000 % 60, ms / 1000 % 60);
  if (ms % 1000 != 0) text += fmt::format(".{:03}", ms % 1000);
  if (zone_minutes && *zone_minutes == 0) return text + "Z";
  if (zone_minutes) text += fmt::format("{:+03}:{:02}", *zone_minutes / 60, std::abs(*zone_minutes) % 60);
  return text;
}

/// Whole rows that are alike: a logger that writes a line twice.
bool same_rows(const SourceTable& table, std::size_t a, std::size_t b) {
  for (std::size_t column = 0; column < table.columns(); ++column) {
    if (table.cell(a, column) != table.cell(b, column)) return false;
  }
  return true;
}

/// Keeps the rows whose time comes after the one before; drops lines written twice.
Status keep_rows(const SourceTable& table, std::size_t column, const std::vector<double>& time_s, TimeReading& out) {
  std::size_t repeated = 0;
  std::size_t first_repeated = 0;
  for (std::size_t row = 0; row < time_s.size(); ++row) {
    if (!out.rows.empty() && !(time_s[row] > out.time_s.back())) {
      if (time_s[row] < out.time_s.back() || !same_rows(table, row, out.rows.back())) {
        return at_cell(ErrorCode::csv_time_order, table, row, column);
      }
      if (repeated++ == 0) first_repeated = row;
      continue;
    }
    if (std::isnan(time_s[row])) return at_cell(ErrorCode::csv_time_order, table, row, column);
    out.time_s.push_back(time_s[row]);
    out.rows.push_back(row);
  }
  if (repeated > 0) {
    out.warnings.push_back(
        {ErrorCode::time_repeated,
         {{"file", table.form.file}, {"line", lineage(table, first_repeated)}, {"count", std::to_string(repeated)}}});
  }
  return {};
}

/// Seconds, milliseconds, microseconds or nanoseconds since 1970, by their size: 1985 to 2128. Empty: none of them.
std::string epoch_unit(double value) {
  constexpr double first_s = 5e8;
  constexpr double last_s = 5e9;
  for (const auto& [unit, scale] :
       std::array<std::pair<const char*, double>, 4>{{{"s", 1.0}, {"ms", 1e3}, {"us", 1e6}, {"ns", 1e9}}}) {
    if (value >= first_s * scale && value < last_s * scale) return unit;
  }
  return {};
}

Result<std::vector<double>> numbers_in(const SourceTable& table, std::size_t column) {
  std::vector<double> values;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    const std::string_view cell = table.cell(row, column);
    if (means_missing(cell)) return at_cell(ErrorCode::csv_time_order, table, row, column);
    const auto value = table.form.numbers.number(cell);
    if (!value) return at_cell(ErrorCode::csv_bad_number, table, row, column);
    values.push_back(*value);
  }
  return values;
}

bool is_labview(const SourceTable& table) {
  return table.block_end > 0 && table.cells.at(0, 0).starts_with("LabVIEW");
}

/// Numbers: elapsed time in a unit that is known, or time since 1970.
Result<TimeReading> read_numbers(const SourceTable& table, std::size_t column, std::string unit, double scale) {
  TimeReading out;
  out.columns = {column};
  ZD_TRY(std::vector<double> values, numbers_in(table, column));
  const double first = values.front();
  const bool labview = is_labview(table);
  const std::string size = labview ? std::string() : epoch_unit(first);
  const bool named = !unit.empty();
  if (!size.empty() && (!named || unit_from(unit)->scale == 1.0 || unit_from(size)->scale == unit_from(unit)->scale)) {
    out.rule = "epoch";
    unit = size;
  } else {
    out.rule = "elapsed";
  }
  if (unit.empty() && scale == 0.0) {
    return fail(ErrorCode::time_unit_unknown,
                {{"file", table.form.file},
                 {"column", table.name_of(column)},
                 {"found", table.form.file.empty() ? "" : std::string(table.cell(0, column))}});
  }
  out.unit = unit;
  const double factor = scale != 0.0 ? scale : unit_from(unit)->scale;
  const bool contract = table.names[column] == "time_s" && out.rule == "elapsed";
  // A recording in the contract's form keeps its own zero: runs that belong together may share it.
  const double zero = contract ? 0.0 : first;
  for (double& value : values) value = (value - zero) * factor;
  if (out.rule == "epoch") {
    out.start = iso_text(std::llround(first * factor * 1e3) * 1'000'000, 0);
    out.warnings.push_back(
        {ErrorCode::time_epoch, {{"column", table.name_of(column)}, {"unit", unit}, {"start", out.start}}});
  } else if (labview && first > 1e9) {
    out.start = iso_text(std::llround((first - seconds_1904_to_1970) * 1e3) * 1'000'000, 0);
  }
  ZD_CHECK(keep_rows(table, column, values, out));
  return out;
}

struct ClockColumns {
  std::size_t first = 0;              // date and time, date, or time of day
  std::optional<std::size_t> of_day;  // time of day beside a date
  std::optional<std::size_t> milliseconds;
  std::string format;
};

std::optional<ClockText> clock_at(const SourceTable& table, std::size_t row, const ClockColumns& columns) {
  const auto read = [&](std::string_view cell) {
    return columns.format.empty() ? read_clock_text(cell) : read_clock_text(cell, columns.format);
  };
  if (!columns.of_day) return read(table.cell(row, columns.first));
  if (!columns.format.empty()) {
    return read(std::string(table.cell(row, columns.first)) + " " + std::string(table.cell(row, *columns.of_day)));
  }
  auto date = read(table.cell(row, columns.first));
  const auto time = read(table.cell(row, *columns.of_day));
  if (!date || !time || !time->has_time || time->has_date()) return std::nullopt;
  date->has_time = true;
  date->of_day_ns = time->of_day_ns;
  date->whole_seconds = time->whole_seconds;
  date->zone_minutes = time->zone_minutes;
  return date;
}

std::string name_of_order(DateOrder order) {
  switch (order) {
    case DateOrder::year_month_day:
      return "year-month-day";
    case DateOrder::day_month_year:
      return "day-month-year";
    case DateOrder::month_day_year:
      return "month-day-year";
  }
  return {};
}

/// A zone in the header: "Date Time, GMT+01:00".
std::optional<int> zone_in(std::string_view header) {
  for (const std::string_view word : {"GMT", "UTC"}) {
    const auto at = header.find(word);
    if (at == std::string_view::npos) continue;
    const std::string_view rest = header.substr(at, 9);
    for (const std::size_t length : {rest.size(), std::size_t{8}, std::size_t{6}, std::size_t{3}}) {
      if (length > rest.size()) continue;
      const auto clock = read_clock_text("00:00 " + std::string(rest.substr(0, length)));
      if (clock && clock->zone_minutes) return clock->zone_minutes;
    }
  }
  return std::nullopt;
}

/// The clock of each row in ns, its zone taken off, for each order that a date may have.
struct ClockSeries {
  std::vector<DateOrder> orders;                 // possible for every row
  std::vector<std::vector<std::int64_t>> at_ns;  // for each order
  bool has_date = true;
  std::optional<int> zone_minutes;  // of the first row
};

Result<double> milliseconds_at(const SourceTable& table, std::size_t row, std::size_t column) {
  ZD_TRY(const double ms, table.number(row, column));
  return std::isnan(ms) ? 0.0 : ms;
}

Result<ClockSeries> clock_series(const SourceTable& table, const ClockColumns& columns) {
  ClockSeries out;
  std::vector<ClockText> clocks;
  for (std::size_t row = 0; row < table.rows.size(); ++row) {
    auto clock = clock_at(table, row, columns);
    if (!clock) return at_cell(ErrorCode::time_unreadable, table, row, columns.first);
    if (row == 0) {
      out.orders = clock->orders;
      out.has_date = clock->has_date();
      out.zone_minutes = clock->zone_minutes;
    }
    if (clock->has_date() != out.has_date) return at_cell(ErrorCode::time_unreadable, table, row, columns.first);
    std::erase_if(out.orders, [&](DateOrder order) {
      const bool allowed = std::find(clock->orders.begin(), clock->orders.end(), order) != clock->orders.end();
      return !allowed || !day_of(*clock, order);
    });
    if (out.has_date && out.orders.empty()) return at_cell(ErrorCode::time_unreadable, table, row, columns.first);
    if (columns.milliseconds && clock->whole_seconds) {
      ZD_TRY(const double ms, milliseconds_at(table, row, *columns.milliseconds));
      clock->of_day_ns += std::llround(ms * 1e6);
    }
    clocks.push_back(std::move(*clock));
  }
  const std::optional<int> of_header = zone_in(table.names[columns.first]);
  if (!out.zone_minutes) out.zone_minutes = of_header;
  if (!out.has_date) out.orders = {DateOrder::year_month_day};
  for (const DateOrder order : out.orders) {
    std::vector<std::int64_t> at_ns;
    for (const ClockText& clock : clocks) {
      const std::int64_t day = out.has_date ? day_of(clock, order)->time_since_epoch().count() : 0;
      const std::int64_t zone = std::int64_t{clock.zone_minutes.value_or(of_header.value_or(0))} * 60 * ns_per_s;
      at_ns.push_back(day * day_ns + clock.of_day_ns - zone);
    }
    out.at_ns.push_back(std::move(at_ns));
  }
  return out;
}

std::int64_t middle_step(const std::vector<std::int64_t>& at_ns) {
  std::vector<std::int64_t> steps;
  for (std::size_t k = 0; k + 1 < at_ns.size(); ++k) {
    if (at_ns[k + 1] > at_ns[k]) steps.push_back(at_ns[k + 1] - at_ns[k]);
  }
  if (steps.empty()) return ns_per_s;
  const auto middle = steps.begin() + std::ssize(steps) / 2;
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// A local clock without zone goes back by an hour when summer time ends, and to 0 at midnight where it has no date.
void undo_clock_steps(const SourceTable& table, const ClockSeries& series, std::vector<std::int64_t>& at_ns,
                      std::vector<Error>& warnings) {
  const std::int64_t step = middle_step(at_ns);
  const std::int64_t tolerance = std::max(3 * step, 60 * ns_per_s);
  const auto warn = [&](ErrorCode code, std::size_t row) {
    warnings.push_back({code, {{"file", table.form.file}, {"line", lineage(table, row)}}});
  };
  std::int64_t shift = 0;
  for (std::size_t k = 1; k < at_ns.size(); ++k) {
    const std::int64_t before = at_ns[k - 1];
    at_ns[k] += shift;
    const std::int64_t moved = at_ns[k] - before;
    if (!series.has_date && moved < -day_ns / 2) {
      shift += day_ns;
      at_ns[k] += day_ns;
      warn(ErrorCode::time_midnight, k);
    } else if (series.has_date && !series.zone_minutes && moved <= 0 && moved + hour_ns > 0 &&
               moved + hour_ns <= tolerance) {
      shift += hour_ns;
      at_ns[k] += hour_ns;
      warn(ErrorCode::time_summer_end, k);
    } else if (series.has_date && !series.zone_minutes && std::abs(moved - hour_ns - step) <= step &&
               step < hour_ns / 4) {
      warn(ErrorCode::time_hour_missing, k);
    }
  }
}

Result<TimeReading> read_clock(const SourceTable& table, const ClockColumns& columns) {
  TimeReading out;
  out.columns = {columns.first};
  if (columns.of_day) out.columns.push_back(*columns.of_day);
  if (columns.milliseconds) out.columns.push_back(*columns.milliseconds);
  ZD_TRY(ClockSeries series, clock_series(table, columns));
  out.rule = series.has_date ? "clock" : "time-of-day";
  std::vector<std::int64_t>& at_ns = series.at_ns.front();
  const std::string first(table.cell(0, columns.first));
  for (std::size_t other = 1; other < series.at_ns.size(); ++other) {
    for (std::size_t row = 0; row < at_ns.size(); ++row) {
      if (series.at_ns[other][row] - series.at_ns[other].front() == at_ns[row] - at_ns.front()) continue;
      return at_cell(ErrorCode::time_ambiguous, table, 0, columns.first);
    }
  }
  if (series.at_ns.size() > 1) {  // the date stays the same: it may be either, and no time depends on it
    out.warnings.push_back(
        {ErrorCode::time_start_unknown, {{"column", table.name_of(columns.first)}, {"found", first}}});
  } else if (series.has_date) {
    out.order = name_of_order(series.orders.front());
    const std::int64_t zone = std::int64_t{series.zone_minutes.value_or(0)} * 60 * ns_per_s;
    out.start = iso_text(at_ns.front() + zone, series.zone_minutes);
  }
  undo_clock_steps(table, series, at_ns, out.warnings);
  std::vector<double> time_s;
  for (const std::int64_t at : at_ns) time_s.push_back(static_cast<double>(at - at_ns.front()) / 1e9);
  ZD_CHECK(keep_rows(table, columns.first, time_s, out));
  return out;
}

/// Rows that come evenly and carry no time: LabVIEW's Delta_X, the same for every channel.
std::optional<TimeReading> read_interval(const SourceTable& table) {
  for (std::size_t row = 0; row < table.block_end; ++row) {
    if (table.cells.at(row, 0) != "Delta_X") continue;
    const auto step = table.form.numbers.number(table.cells.at(row, 1));
    if (!step || *step <= 0.0) return std::nullopt;
    for (std::size_t column = 2; column < table.cells.columns(row); ++column) {
      const std::string_view cell = table.cells.at(row, column);
      if (!cell.empty() && table.form.numbers.number(cell) != step) return std::nullopt;
    }
    const int x_values = table.column("X_Value");
    if (x_values >= 0 && contents_of(table, static_cast<std::size_t>(x_values)).numbers > 0) return std::nullopt;
    TimeReading out;
    out.rule = "interval";
    out.unit = "s";
    if (const int at = table.column("X_Value"); at >= 0) out.columns = {static_cast<std::size_t>(at)};
    for (std::size_t k = 0; k < table.rows.size(); ++k) {
      out.rows.push_back(k);
      out.time_s.push_back(static_cast<double>(k) * *step);
    }
    return out;
  }
  return std::nullopt;
}

Result<std::vector<std::size_t>> columns_in_map(const SourceTable& table, const HeaderMap& map,
                                                const std::vector<std::string>& labels) {
  std::vector<std::size_t> out;
  for (const std::string& name : map.time.columns) {
    const auto column = find_column(name, table.names, labels);
    if (!column) {
      std::string available;
      for (std::size_t c = 0; c < table.columns(); ++c) available += (c == 0 ? "" : ", ") + table.name_of(c);
      return fail(ErrorCode::map_column_missing,
                  {{"file", table.form.file}, {"column", name}, {"available", available}});
    }
    out.push_back(*column);
  }
  for (std::size_t c = 0; out.empty() && c < table.columns(); ++c) {
    const auto* rule = map.rule_for(table.names[c], labels[c], c);
    if (rule != nullptr && *rule && (*rule)->channel == "time_s") out.push_back(c);
  }
  return out;
}

/// A clock beside elapsed time gives the date of the start, where its date has one meaning, and must pass as fast: what
/// calls itself ms may be something else.
Status agrees_with_clock(const SourceTable& table, std::size_t column, TimeReading& out) {
  const auto first = read_clock_text(table.cell(out.rows.front(), column));
  const auto last = read_clock_text(table.cell(out.rows.back(), column));
  if (!first || !last || first->orders.size() != 1 || last->orders != first->orders) return {};
  const auto first_day = day_of(*first, first->orders.front());
  const auto last_day = day_of(*last, first->orders.front());
  if (!first_day || !last_day) return {};
  const std::int64_t start_ns = first_day->time_since_epoch().count() * day_ns + first->of_day_ns;
  if (out.start.empty()) out.start = iso_text(start_ns, first->zone_minutes);
  const double clock_s = static_cast<double>((*last_day - *first_day).count()) * 86400.0 +
                         static_cast<double>(last->of_day_ns - first->of_day_ns) / 1e9;
  const double elapsed_s = out.time_s.back() - out.time_s.front();
  // The clock may show minutes only, and summer time may end.
  const bool shows_seconds = (first->of_day_ns % (60 * ns_per_s)) != 0 || (last->of_day_ns % (60 * ns_per_s)) != 0;
  const double resolution_s = shows_seconds ? 2.0 : 61.0;
  const double difference_s = std::abs(clock_s - elapsed_s);
  const bool summer_time = std::abs(difference_s - 3600.0) < resolution_s;
  if (difference_s < resolution_s + 0.01 * clock_s || summer_time) return {};
  return fail(ErrorCode::unit_conflict, {{"file", table.form.file},
                                         {"column", table.name_of(out.columns.front())},
                                         {"found", fmt::format("{} ({:g} s)", out.unit, elapsed_s)},
                                         {"expected", fmt::format("{} ({:g} s)", table.name_of(column), clock_s)}});
}

/// A column "ms" right after a clock without fractions.
std::optional<std::size_t> milliseconds_beside(const SourceTable& table, std::size_t clock) {
  const std::size_t next = clock + 1;
  if (next >= table.columns()) return std::nullopt;
  const std::string name = in_lower_case(table.names[next]);
  if (name != "ms" && name != "msec" && name != "milliseconds" && name != "毫秒") return std::nullopt;
  return contents_of(table, next).is_number() ? std::optional(next) : std::nullopt;
}

}  // namespace

Result<TimeReading> read_time(const SourceTable& table, const HeaderMap& map, const std::vector<std::string>& labels) {
  ZD_TRY(std::vector<std::size_t> chosen, columns_in_map(table, map, labels));
  std::vector<Contents> contents;
  for (std::size_t c = 0; c < table.columns(); ++c) contents.push_back(contents_of(table, c));
  double scale = 0.0;
  std::string unit = map.time.unit;
  if (chosen.size() == 1) {
    const auto* rule = map.rule_for(table.names[chosen.front()], labels[chosen.front()], chosen.front());
    if (rule != nullptr && *rule && (*rule)->channel == "time_s") {
      scale = (*rule)->scale.value_or(0.0);
      if (unit.empty()) unit = (*rule)->unit;
      if (unit.empty() && scale == 0.0) unit = time_unit_of(table, chosen.front());
      // The user says that it is in seconds by calling it time_s.
      if (unit.empty() && scale == 0.0) unit = "s";
    }
  }
  const auto first_where = [&](auto condition) -> std::optional<std::size_t> {
    for (std::size_t c = 0; c < table.columns(); ++c) {
      const auto* rule = map.rule_for(table.names[c], labels[c], c);
      if (rule == nullptr && condition(c)) return c;
    }
    return std::nullopt;
  };
  ClockColumns clock;
  clock.format = map.time.format;
  if (chosen.empty()) {
    if (const int at = table.column("time_s"); at >= 0) {
      chosen = {static_cast<std::size_t>(at)};
    } else if (const auto elapsed = first_where([&](std::size_t c) {
                 return contents[c].is_number() && is_time_name(table.names[c]) && !time_unit_of(table, c).empty();
               })) {
      chosen = {*elapsed};
    } else if (const auto full = first_where([&](std::size_t c) { return contents[c].is_date_and_time(); })) {
      chosen = {*full};
    } else if (const auto date = first_where([&](std::size_t c) { return contents[c].is_date(); })) {
      chosen = {*date};
      if (const auto of_day = first_where([&](std::size_t c) { return contents[c].is_time_of_day(); })) {
        chosen.push_back(*of_day);
      }
    } else if (const auto of_day = first_where([&](std::size_t c) { return contents[c].is_time_of_day(); })) {
      chosen = {*of_day};
    } else if (const auto number = first_where(
                   [&](std::size_t c) { return contents[c].is_number() && is_time_name(table.names[c]); })) {
      chosen = {*number};
    } else if (auto even = read_interval(table)) {
      return *even;
    }
  }
  if (chosen.empty()) {
    std::string available;
    for (std::size_t c = 0; c < table.columns(); ++c) available += (c == 0 ? "" : ", ") + table.name_of(c);
    return fail(ErrorCode::time_missing, {{"file", table.form.file}, {"available", available}});
  }
  const std::size_t first = chosen.front();
  if (chosen.size() == 1 && map.time.format.empty() && contents[first].dates == 0 && contents[first].times == 0) {
    if (unit.empty() && scale == 0.0) unit = time_unit_of(table, first);
    if (unit.empty() && scale == 0.0 && is_labview(table) && table.names[first] == "X_Value") unit = "s";
    ZD_TRY(TimeReading out, read_numbers(table, first, unit, scale));
    const auto beside = first_where([&](std::size_t c) { return contents[c].is_date_and_time(); });
    if (beside) ZD_CHECK(agrees_with_clock(table, *beside, out));
    return out;
  }
  clock.first = first;
  if (chosen.size() == 2) clock.of_day = chosen[1];
  clock.milliseconds = milliseconds_beside(table, chosen.back());
  return read_clock(table, clock);
}

}  // namespace zerodrift::recording
