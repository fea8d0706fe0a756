#include "core/recording/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/file.h"
#include "core/base/json.h"

namespace zerodrift::recording {
namespace {

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \r\v\f";
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/// The separator is the one that the header holds most of, outside quotes.
char separator_of(std::string_view header) {
  char best = ',';
  std::ptrdiff_t most = 0;
  for (const char candidate : {',', ';', '\t'}) {
    std::ptrdiff_t count = 0;
    bool quoted = false;
    for (const char c : header) {
      if (c == '"') quoted = !quoted;
      count += c == candidate && !quoted;
    }
    if (count > most) {
      most = count;
      best = candidate;
    }
  }
  return best;
}

bool parse_number(std::string_view text, double& value) {
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

/// What a spreadsheet would take for a formula, had it not the apostrophe before it that marks text there; any number
/// of apostrophes, so that one more and one less are each other's way back.
bool is_formula(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of('\''), text.size()));
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  double number = 0.0;
  return !text.empty() && std::string_view("=+-@\t\r\n").find(text.front()) != std::string_view::npos && text != "-" &&
         !parse_number(text, number);
}

/// Cells of one line; quotes as in RFC 4180, but a quoted cell may not span lines (no recording needs it).
std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  std::string cell;
  bool quoted = false;
  bool was_quoted = false;
  const auto push = [&] {
    std::string text = was_quoted ? cell : std::string(trimmed(cell));
    if (text.starts_with('\'') && is_formula(text)) text.erase(0, 1);
    cells.push_back(std::move(text));
    cell.clear();
    was_quoted = false;
  };
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quoted && c == '"' && i + 1 < line.size() && line[i + 1] == '"') {
      cell += '"';
      ++i;
    } else if (c == '"' && (quoted || trimmed(cell).empty())) {
      quoted = !quoted;
      was_quoted = true;
      if (quoted) cell.clear();
    } else if (c == separator && !quoted) {
      push();
    } else if (!(was_quoted && !quoted && (c == '\r' || c == ' '))) {
      cell += c;
    }
  }
  push();
  return cells;
}

bool means_missing(std::string_view cell) {
  return cell.empty() || cell == "nan" || cell == "NaN" || cell == "NAN";
}

/// A column of words, under a name that says no unit: what the engineer noted beside the numbers, and no channel.
bool is_remark(const TextTable& table, std::size_t column) {
  if (kind_of(table.header[column]) != ChannelKind::input) return false;
  bool any = false;
  for (const auto& row : table.rows) {
    const std::string& cell = row[column];
    if (means_missing(cell)) continue;
    if (std::string_view("+-.,0123456789").find(cell.front()) != std::string_view::npos) return false;
    any = true;
  }
  return any;
}

/// Times in another unit than seconds would make each simulated step thousands of steps, and every time constant wrong.
Status check_times(const Recording& recording, const std::string& file) {
  constexpr double longest_period_s = 3600.0;
  constexpr double longest_s = 100.0 * 86400.0;
  if (recording.rows() < 2) return {};
  std::vector<double> periods_s(recording.rows() - 1);
  for (std::size_t k = 0; k < periods_s.size(); ++k) periods_s[k] = recording.time_s[k + 1] - recording.time_s[k];
  const auto middle = periods_s.begin() + std::ssize(periods_s) / 2;
  std::nth_element(periods_s.begin(), middle, periods_s.end());
  const double whole_s = recording.time_s.back() - recording.time_s.front();
  if (*middle <= longest_period_s && whole_s <= longest_s) return {};
  return fail(ErrorCode::data_does_not_fit,
              {{"what", file + ", column time_s"},
               {"found", fmt::format("a row each {:g} s, {:g} s in all", *middle, whole_s)},
               {"expected",
                "seconds: a row an hour at least, 100 days at most (is it in milliseconds, or is one time wrong?)"}});
}

/// Other bytes, as an old file's name has them, are told by the replacement character: the whole file would be no
/// UTF-8.
std::string in_utf8(std::string text) {
  const bool plain = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  return plain ? text : nlohmann::json::parse(json_text(text)).get<std::string>();
}

/// The name of a column as every other file can hold it: bytes that are no UTF-8 are read as Latin-1, so that two names
/// that differ still do.
std::string column_name(std::string name) {
  if (in_utf8(name) == name) return name;
  std::string read;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      read += c;
    } else {
      read += static_cast<char>(0xC0 | (byte >> 6));
      read += static_cast<char>(0x80 | (byte & 0x3F));
    }
  }
  return read;
}

}  // namespace

int TextTable::column(std::string_view name) const {
  const auto at = std::find(header.begin(), header.end(), name);
  return at == header.end() ? -1 : static_cast<int>(at - header.begin());
}

Result<TextTable> parse_table(std::string_view text, const std::string& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.find('\0') != std::string_view::npos) {
    return fail(ErrorCode::wrong_format, {{"file", file}, {"found", "binary data"}, {"expected", "a CSV text table"}});
  }
  TextTable table;
  table.file = file;
  char separator = ',';
  int line_number = 0;
  while (!text.empty()) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    ++line_number;
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;  // loggers write their remarks so
    if (table.header.empty()) {
      separator = separator_of(line);
      table.header = cells_of(line, separator);
      continue;
    }
    auto cells = cells_of(line, separator);
    if (cells.size() != table.header.size()) {
      return fail(ErrorCode::csv_cell_count, {{"file", file},
                                              {"line", std::to_string(line_number)},
                                              {"found", std::to_string(cells.size())},
                                              {"expected", std::to_string(table.header.size())}});
    }
    table.rows.push_back(std::move(cells));
    table.lines.push_back(line_number);
  }
  if (table.header.empty() || table.rows.empty()) return fail(ErrorCode::csv_empty, {{"file", file}});
  return table;
}

Result<TextTable> read_table(const std::filesystem::path& path) {
  ZD_TRY(const std::string text, read_file(path));
  return parse_table(text, path.string());
}

Result<double> number_in(const TextTable& table, std::size_t row, int column) {
  const std::string& cell = table.rows[row][static_cast<std::size_t>(column)];
  if (means_missing(cell)) return std::numeric_limits<double>::quiet_NaN();
  double value = 0.0;
  if (parse_number(cell, value)) return value;
  return fail(ErrorCode::csv_bad_number, {{"file", table.file},
                                          {"line", std::to_string(table.lines[row])},
                                          {"column", table.header[static_cast<std::size_t>(column)]},
                                          {"found", cell}});
}

Result<Recording> parse_recording(std::string_view text, const std::string& file, const CsvOptions& options) {
  ZD_TRY(TextTable table, parse_table(text, file));
  for (auto& name : table.header) {
    name = column_name(std::move(name));
    if (const auto at = options.header_map.find(name); at != options.header_map.end()) name = at->second;
  }
  if (table.header.front() != "time_s") {
    return fail(ErrorCode::csv_bad_header,
                {{"file", file}, {"column", "1"}, {"found", table.header.front()}, {"expected", "time_s"}});
  }
  std::set<std::string> seen;
  for (std::size_t c = 0; c < table.header.size(); ++c) {
    const auto& name = table.header[c];
    if (name.empty() || !seen.insert(name).second) {
      return fail(ErrorCode::csv_bad_header, {{"file", file},
                                              {"column", std::to_string(c + 1)},
                                              {"found", name.empty() ? "(no name)" : name + " (a second time)"},
                                              {"expected", "a name of its own for each column"}});
    }
  }
  Recording out;
  out.name = file;
  std::vector<std::size_t> columns;
  for (std::size_t c = 1; c < table.header.size(); ++c) {
    if (is_remark(table, c)) continue;
    columns.push_back(c);
    out.channels.push_back({table.header[c], {}});
  }
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    ZD_TRY(const double time_s, number_in(table, r, 0));
    if (std::isnan(time_s) || (!out.time_s.empty() && time_s <= out.time_s.back())) {
      return fail(ErrorCode::csv_time_order,
                  {{"file", file}, {"line", std::to_string(table.lines[r])}, {"found", table.rows[r][0]}});
    }
    out.time_s.push_back(time_s);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      ZD_TRY(const double value, number_in(table, r, static_cast<int>(columns[i])));
      out.channels[i].values.push_back(value);
    }
  }
  ZD_CHECK(check_times(out, file));
  return out;
}

Result<Recording> read_recording(const std::filesystem::path& path, const CsvOptions& options) {
  ZD_TRY(const std::string text, read_file(path));
  return parse_recording(text, path.string(), options);
}

std::string number_text(double value) {
  return std::isnan(value) ? std::string() : fmt::format("{}", value);
}

std::string cell_text(std::string_view entered) {
  std::string text = in_utf8((is_formula(entered) ? "'" : "") + std::string(entered));
  // Blanks at its ends belong to a quoted cell only.
  if (text.find_first_of(",;\t\"\r\n") == std::string_view::npos && trimmed(text) == text) return text;
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + "\"";
}

std::string to_csv(const Recording& recording) {
  std::string out = "time_s";
  for (const auto& c : recording.channels) out += "," + cell_text(c.name);
  out += '\n';
  for (std::size_t r = 0; r < recording.rows(); ++r) {
    out += number_text(recording.time_s[r]);
    for (const auto& c : recording.channels) out += "," + number_text(c.values[r]);
    out += '\n';
  }
  return out;
}

Status write_recording(const std::filesystem::path& path, const Recording& recording) {
  return write_file(path, to_csv(recording));
}

}  // namespace zerodrift::recording
