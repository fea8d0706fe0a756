// Vendors' laser files. None is specified in public; what is here agrees with several independent readers:
// .rtl (Renishaw linear): sections in capitals with "::", targets in mm, deviations in um, deviation = measured -
// target; runs alternate in direction and list their targets in the order they were driven.
// .REN: compensation start, end, spacing, then "No. / Axis position / Combined": compensation values, so error =
// -value. .pos (API): tables "Position <tab> Bidirectional Avg Error", "Forward Directional Avg Error" and "Backward
// Directional Avg Error" in mm. The readers known turn its sign, for they make compensations of it.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/compensation/laser_parts.h"
#include "core/compensation/laser_words.h"
#include "core/recording/import/cells.h"
#include "core/recording/import/number_format.h"

namespace zerodrift::compensation::laser_parts {
namespace {

using recording::NumberFormat;

tl::unexpected<Error> bad_number(const std::string& file, int line, const std::string& column, std::string_view found) {
  return fail(ErrorCode::csv_bad_number,
              {{"file", file}, {"line", std::to_string(line)}, {"column", column}, {"found", std::string(found)}});
}

std::string after_colon(std::string_view line) {
  const auto colon = line.find(':');
  if (colon == std::string_view::npos) return {};
  const auto first = line.find_first_not_of(" \t", colon + 1);
  return first == std::string_view::npos ? std::string{} : std::string(line.substr(first));
}

std::vector<std::string> words_between(std::string_view line, std::string_view marks) {
  std::vector<std::string> words;
  while (!line.empty()) {
    const std::size_t end = std::min(line.find_first_of(marks), line.size());
    if (end > 0) words.emplace_back(line.substr(0, end));
    line.remove_prefix(std::min(end + 1, line.size()));
  }
  return words;
}

bool begins_numeric(std::string_view line) {
  return !line.empty() && std::string_view("+-.,0123456789").find(line[0]) != std::string_view::npos;
}

/// How the lines of numbers in a file are written: a comma may be a decimal mark, or stand between numbers.
struct NumberLines {
  std::string_view marks = " \t;";
  NumberFormat format;

  std::vector<std::string> words(std::string_view line) const { return words_between(line, marks); }
};

Result<NumberLines> number_lines(const std::vector<Line>& lines, const std::string& file) {
  NumberLines out;
  recording::NumberEvidence evidence;
  for (const Line& line : lines) {
    if (!begins_numeric(line.text)) continue;
    for (const std::string& word : words_between(line.text, " \t;")) {
      // "1,2,-0.300": three numbers; "0.0," the end of one.
      const bool between =
          word.ends_with(',') || (std::count(word.begin(), word.end(), ',') > 0 &&
                                  word.find('.') != std::string::npos && word.rfind('.') > word.find(','));
      if (between) return NumberLines{" \t;,", {}};
      evidence.add(word, [&] { return recording::NumberEvidence::Place{word, line.number, "numbers"}; });
    }
  }
  ZD_TRY(out.format, evidence.decide(file));
  return out;
}

struct Deviation {
  int run = 0;
  std::size_t target = 0;  // from 1
  double um = 0.0;
};

struct Rtl {
  std::vector<double> targets_mm;
  std::vector<Deviation> deviations;
  std::string machine;
  std::string axis;
};

Status read_targets(const Line& line, const std::string& file, const NumberLines& numbers, Rtl& rtl) {
  for (const auto& word : numbers.words(line.text)) {
    const auto value = numbers.format.number(word);
    if (!value) return bad_number(file, line.number, "Targets", word);
    rtl.targets_mm.push_back(*value);
  }
  return {};
}

Status read_deviation(const Line& line, const std::string& file, const NumberLines& numbers, Rtl& rtl) {
  const auto words = numbers.words(line.text);
  std::array<double, 3> values{};
  if (words.size() != 3) return bad_number(file, line.number, "Run Target Data", line.text);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = numbers.format.number(words[i]);
    if (!value) return bad_number(file, line.number, "Run Target Data", words[i]);
    values[i] = *value;
  }
  if (values[1] < 1 || values[1] > static_cast<double>(rtl.targets_mm.size()) || values[1] != std::floor(values[1])) {
    return bad_number(file, line.number, "Target", words[1]);
  }
  const auto run = run_number(values[0]);
  if (!run) return bad_number(file, line.number, "Run", words[0]);
  rtl.deviations.push_back({*run, static_cast<std::size_t>(values[1]), values[2]});
  return {};
}

/// "Linear" and "Positioning" are read; angular, straightness or rotary reports hold other numbers in the same form.
Status check_kind(const Line& line, const std::string& file) {
  const std::string kind = lowered(after_colon(line.text));
  if (kind.empty() || kind.find("linear") != std::string::npos || kind.find("positioning") != std::string::npos)
    return {};
  return fail(ErrorCode::wrong_format, {{"file", file},
                                        {"found", fmt::format("a report of another kind ({})", after_colon(line.text))},
                                        {"expected", "one of a linear axis; rotary axes are not compensated"}});
}

/// Targets are in mm and deviations in um by the form itself; a line that says otherwise changes every number.
Status check_units(const Line& line, std::string_view section, const std::string& file) {
  const std::string text = lowered(std::string(line.text));
  const std::string key = text.substr(0, text.find(':'));
  const bool of_units = key.size() < text.size() && (key.ends_with("unit") || key.ends_with("units"));
  if (!of_units || section == "USER-TEXT::" || section == "ENVIRONMENT::") return {};
  const std::string value = lowered(after_colon(line.text));
  const bool of_errors = key.find("dev") != std::string::npos || key.find("err") != std::string::npos;
  static const std::array<std::string_view, 4> small = {"um", "µm", "micron", "microns"};
  static const std::array<std::string_view, 5> large = {"mm", "metric", "millimetres", "millimeters", "millimetre"};
  const auto is_one = [&](const auto& words) { return std::find(words.begin(), words.end(), value) != words.end(); };
  if (of_errors ? is_one(small) : is_one(large)) return {};
  return fail(ErrorCode::column_unclear, {{"file", file},
                                          {"line", std::to_string(line.number)},
                                          {"column", std::string(line.text.substr(0, line.text.find(':')))},
                                          {"found", after_colon(line.text)},
                                          {"expected", of_errors ? "um" : "mm"}});
}

class RtlReader {
 public:
  RtlReader(const std::string& file, const NumberLines& numbers) : m_file(file), m_numbers(numbers) {}

  Status take(const Line& line) {
    if (line.text.ends_with("::")) {
      m_section = line.text;
      m_in_targets = false;
      return {};
    }
    ZD_CHECK(check_units(line, m_section, m_file));
    if (m_section == "HEADER::" && line.text.starts_with("File type:")) return check_kind(line, m_file);
    if (m_section == "TARGET DATA::") return take_target_line(line);
    if (m_section == "USER-TEXT::") {
      if (line.text.starts_with("Machine:")) m_rtl.machine = after_colon(line.text);
      if (line.text.starts_with("Axis:")) m_rtl.axis = after_colon(line.text);
    }
    if (m_section == "RUNS::" && line.text.starts_with("Run-count:")) m_runs = line;
    if (m_section == "DEVIATIONS::" && begins_numeric(line.text)) return read_deviation(line, m_file, m_numbers, m_rtl);
    return {};
  }

  Result<Rtl> finish() {
    if (m_rtl.targets_mm.empty() || m_rtl.deviations.empty()) {
      return fail(ErrorCode::wrong_format, {{"file", m_file},
                                            {"found", m_rtl.targets_mm.empty() ? "no targets" : "no deviations"},
                                            {"expected", "a linear report with TARGET DATA:: and DEVIATIONS::"}});
    }
    ZD_CHECK(check_count(m_targets, m_rtl.targets_mm.size(), "Target-count"));
    std::vector<int> runs;
    for (const Deviation& one : m_rtl.deviations) {
      if (std::find(runs.begin(), runs.end(), one.run) == runs.end()) runs.push_back(one.run);
    }
    ZD_CHECK(check_count(m_runs, runs.size(), "Run-count"));
    return std::move(m_rtl);
  }

 private:
  Status take_target_line(const Line& line) {
    if (line.text.starts_with("Target-count")) m_targets = line;
    if (line.text.starts_with("Targets")) {
      m_in_targets = true;
      const std::string rest = after_colon(line.text);
      return rest.empty() ? Status{} : read_targets({line.number, rest}, m_file, m_numbers, m_rtl);
    }
    if (m_in_targets && begins_numeric(line.text)) return read_targets(line, m_file, m_numbers, m_rtl);
    if (!line.text.empty()) m_in_targets = false;
    return {};
  }

  /// A file that says how many it has and has others was cut, or is read wrongly.
  Status check_count(const Line& line, std::size_t found, const char* what) const {
    const std::string said = after_colon(line.text);
    const auto count = number_from(said);
    if (said.empty() || (count && *count == static_cast<double>(found))) return {};
    return fail(ErrorCode::column_unclear, {{"file", m_file},
                                            {"line", std::to_string(line.number)},
                                            {"column", what},
                                            {"found", std::to_string(found)},
                                            {"expected", said}});
  }

  const std::string& m_file;
  const NumberLines& m_numbers;
  std::string m_section;
  bool m_in_targets = false;
  Line m_targets;
  Line m_runs;
  Rtl m_rtl;
};

Result<Rtl> read_rtl(std::string_view text, const std::string& file) {
  const std::vector<Line> lines = lines_of(text);
  ZD_TRY(const NumberLines numbers, number_lines(lines, file));
  RtlReader reader(file, numbers);
  for (const Line& line : lines) ZD_CHECK(reader.take(line));
  return reader.finish();
}

/// A run's direction is the order in which its targets stand; with one target only, odd runs are taken as upwards.
std::map<int, Approach> directions_of(const Rtl& rtl) {
  std::map<int, std::pair<double, double>> ends;
  for (const auto& one : rtl.deviations) {
    const double at = rtl.targets_mm[one.target - 1];
    ends.try_emplace(one.run, at, at).first->second.second = at;
  }
  std::map<int, Approach> out;
  for (const auto& [run, pair] : ends) {
    const bool down = pair.first == pair.second ? run % 2 == 0 : pair.second < pair.first;
    out[run] = down ? Approach::down : Approach::up;
  }
  return out;
}

/// The line that says the unit of the values: "Units: mm". Nothing where no line does.
Result<std::optional<Unit>> said_unit(const std::vector<Line>& lines, const std::string& file) {
  std::optional<Unit> unit;
  for (const Line& line : lines) {
    if (lowered(std::string(line.text)).find("unit") == std::string::npos) continue;
    const std::string said = after_colon(line.text);
    if (said.empty()) continue;
    unit = unit_of(said);
    if (unit && unit->kind == UnitKind::length) continue;
    return fail(ErrorCode::column_unclear, {{"file", file},
                                            {"line", std::to_string(line.number)},
                                            {"column", "unit"},
                                            {"found", said},
                                            {"expected", "a unit of length: mm, um, in, uin, mil"}});
  }
  return unit;
}

/// A table of an API report: its header says the direction, and that the values are means.
struct PosTable {
  std::optional<Approach> approach;
  double mm_per_position = 1.0;
  double mm_per_error = 1.0;
  std::vector<RawReading> readings;
};

/// "Position (mm) <tab> Forward Directional Avg Error (um)": mm where it says no unit.
Status take_units(const Line& line, const std::string& file, PosTable& table) {
  const std::size_t word = line.text.find_first_of("BF", std::string_view("Position").size());
  const std::size_t split =
      std::min(line.text.find('\t') != std::string_view::npos ? line.text.find('\t') : word, line.text.size());
  for (const bool first : {true, false}) {
    const std::string_view part = first ? line.text.substr(0, split) : line.text.substr(split);
    const auto unit = split_unit(part).unit;
    if (!unit && part.find_first_of("([") == std::string_view::npos) continue;
    if (!unit || unit->kind != UnitKind::length) {
      return fail(ErrorCode::column_unclear, {{"file", file},
                                              {"line", std::to_string(line.number)},
                                              {"column", first ? "Position" : "Error"},
                                              {"found", std::string(recording::trimmed(part))},
                                              {"expected", "a unit of length: mm, um, in, uin, mil"}});
    }
    (first ? table.mm_per_position : table.mm_per_error) = unit->mm;
  }
  return {};
}

Result<std::vector<PosTable>> read_pos_tables(const std::vector<Line>& lines, const std::string& file) {
  ZD_TRY(const NumberLines numbers, number_lines(lines, file));
  std::vector<PosTable> tables;
  bool in_table = false;
  for (const Line& line : lines) {
    const bool header = line.text.starts_with("Position") && line.text.find("Error") != std::string_view::npos;
    if (header) {
      tables.push_back({direction_in_name(line.text), 1.0, 1.0, {}});
      ZD_CHECK(take_units(line, file, tables.back()));
      if (!tables.back().approach && !means_both_directions(line.text)) {
        return fail(ErrorCode::column_unclear, {{"file", file},
                                                {"line", std::to_string(line.number)},
                                                {"column", "Position"},
                                                {"found", std::string(line.text)},
                                                {"expected", "a table of forward, backward or bidirectional errors"}});
      }
    }
    in_table = header || (in_table && (line.text.empty() || begins_numeric(line.text)));
    if (header || !in_table || line.text.empty()) continue;
    const auto words = numbers.words(line.text);
    if (words.size() != 2) return bad_number(file, line.number, "Position, Error", line.text);
    const auto x = numbers.format.number(words[0]);
    const auto v = numbers.format.number(words[1]);
    if (!x || !v) return bad_number(file, line.number, !x ? "Position" : "Error", !x ? words[0] : words[1]);
    const PosTable& table = tables.back();
    tables.back().readings.push_back(
        {table.mm_per_position * *x, table.approach.value_or(Approach::up), 1, um_per_mm * table.mm_per_error * *v});
  }
  return tables;
}

}  // namespace

Result<LaserReport> parse_rtl(std::string_view text, const std::string& file, const LaserOptions& options) {
  ZD_TRY(const Rtl rtl, read_rtl(text, file));
  const auto direction = directions_of(rtl);
  std::map<int, int> cycle;  // run of the file -> cycle within its direction
  std::array<int, 2> count{};
  for (const auto& [run, approach] : direction) cycle[run] = ++count[approach == Approach::up ? 0 : 1];
  std::vector<RawReading> readings;
  for (const auto& one : rtl.deviations) {
    readings.push_back({rtl.targets_mm[one.target - 1], direction.at(one.run), cycle.at(one.run), one.um});
  }
  ZD_TRY(LaserReport report, assemble(readings, file, options));
  const std::size_t whole = direction.size() * rtl.targets_mm.size();
  if (rtl.deviations.size() != whole) {
    report.warnings.push_back(
        fmt::format("{}: {} of {} readings; was the file cut?", file, rtl.deviations.size(), whole));
  }
  report.machine = rtl.machine;
  report.axis = rtl.axis;
  return report;
}

Result<LaserReport> parse_ren(std::string_view text, const std::string& file, const LaserOptions& options) {
  const std::vector<Line> lines = lines_of(text);
  ZD_TRY(const auto unit, said_unit(lines, file));
  ZD_TRY(const NumberLines numbers, number_lines(lines, file));
  std::vector<RawReading> readings;
  int header = 1;
  for (const Line& line : lines) {
    const auto words = numbers.words(line.text);
    const auto x = words.size() > 2 ? numbers.format.number(words[1]) : std::nullopt;
    const auto v = words.size() > 2 ? numbers.format.number(words[2]) : std::nullopt;
    const bool row = words.size() > 2 && numbers.format.number(words[0]);
    if (!row) {
      if (readings.empty() && !line.text.empty()) header = line.number;
      continue;
    }
    if (!x || !v) return bad_number(file, line.number, !x ? "Axis position" : "Combined", !x ? words[1] : words[2]);
    readings.push_back({*x, Approach::up, 1, unit ? -1000.0 * unit->mm * *v : -*v});
  }
  if (!unit) {
    return fail(ErrorCode::column_unclear, {{"file", file},
                                            {"line", std::to_string(header)},
                                            {"column", "Combined"},
                                            {"found", "no unit"},
                                            {"expected", "a line Units: um or Units: mm above the table"}});
  }
  ZD_TRY(LaserReport report, assemble(readings, file, options));
  report.warnings.push_back(fmt::format(
      "{}: compensation values in {} are taken as -error; confirm sign and unit on one point", file, unit->name));
  return report;
}

Result<LaserReport> parse_pos(std::string_view text, const std::string& file, const LaserOptions& options) {
  const std::vector<Line> lines = lines_of(text);
  for (const Line& line : lines) {
    if (line.text.starts_with("File type:")) ZD_CHECK(check_kind(line, file));
  }
  ZD_TRY(const auto unit, said_unit(lines, file));
  if (unit && unit->mm != 1.0) {
    return fail(ErrorCode::wrong_format,
                {{"file", file}, {"found", fmt::format("in {}", unit->name)}, {"expected", "an API report in mm"}});
  }
  ZD_TRY(const std::vector<PosTable> tables, read_pos_tables(lines, file));
  const bool directed =
      std::any_of(tables.begin(), tables.end(), [](const auto& one) { return one.approach.has_value(); });
  std::vector<RawReading> readings;
  for (const PosTable& table : tables) {
    if (directed && !table.approach) continue;  // the means of the others
    readings.insert(readings.end(), table.readings.begin(), table.readings.end());
  }
  ZD_TRY(LaserReport report, assemble(readings, file, options));
  report.warnings.push_back(
      fmt::format("{}: errors in mm, means of several runs; confirm the sign on one point", file));
  if (!directed) {
    report.warnings.push_back(fmt::format("{}: means of both directions; the file says nothing of backlash", file));
  }
  return report;
}

}  // namespace zerodrift::compensation::laser_parts
