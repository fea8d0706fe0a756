// Vendors' laser files. None is specified in public; what is here agrees with several independent readers:
// .rtl (Renishaw linear): sections in capitals with "::", targets in mm, deviations in um, deviation = measured -
// target;
//   runs alternate in direction and list their targets in the order they were driven.
// .REN: compensation start, end, spacing, then "No. / Axis position / Combined": compensation values, so error =
// -value. .pos (API): "Position <tab> Bidirectional Avg Error" in mm; the reader known negates it.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/compensation/laser_parts.h"

namespace zerodrift::compensation::laser_parts {
namespace {

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

Status read_targets(const Line& line, const std::string& file, Rtl& rtl) {
  for (const auto& word : words_of(line.text)) {
    const auto value = number_from(word);
    if (!value) return bad_number(file, line.number, "Targets", word);
    rtl.targets_mm.push_back(*value);
  }
  return {};
}

Status read_deviation(const Line& line, const std::string& file, Rtl& rtl) {
  const auto words = words_of(line.text);
  std::array<double, 3> values{};
  if (words.size() < 3) return bad_number(file, line.number, "Run Target Data", line.text);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto value = number_from(words[i]);
    if (!value) return bad_number(file, line.number, "Run Target Data", words[i]);
    values[i] = *value;
  }
  if (values[1] < 1 || values[1] > static_cast<double>(rtl.targets_mm.size())) {
    return bad_number(file, line.number, "Target", words[1]);
  }
  const auto run = run_number(values[0]);
  if (!run) return bad_number(file, line.number, "Run", words[0]);
  rtl.deviations.push_back({*run, static_cast<std::size_t>(values[1]), values[2]});
  return {};
}

Result<Rtl> read_rtl(std::string_view text, const std::string& file) {
  Rtl rtl;
  std::string section;
  bool in_targets = false;
  for (const Line& line : lines_of(text)) {
    if (line.text.ends_with("::")) {
      section = line.text;
      in_targets = false;
      continue;
    }
    const bool numeric =
        !line.text.empty() && std::string_view("+-.0123456789").find(line.text[0]) != std::string_view::npos;
    if (section == "TARGET DATA::") {
      if (line.text.starts_with("Targets"))
        in_targets = true;
      else if (in_targets && numeric)
        ZD_CHECK(read_targets(line, file, rtl));
      else if (!line.text.empty())
        in_targets = false;
    } else if (section == "USER-TEXT::") {
      if (line.text.starts_with("Machine:")) rtl.machine = after_colon(line.text);
      if (line.text.starts_with("Axis:")) rtl.axis = after_colon(line.text);
    } else if (section == "DEVIATIONS::" && numeric) {
      ZD_CHECK(read_deviation(line, file, rtl));
    }
  }
  if (rtl.targets_mm.empty() || rtl.deviations.empty()) {
    return fail(ErrorCode::wrong_format, {{"file", file},
                                          {"found", rtl.targets_mm.empty() ? "no targets" : "no deviations"},
                                          {"expected", "a linear report with TARGET DATA:: and DEVIATIONS::"}});
  }
  return rtl;
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

/// Rows of two or three numbers after a header; `first` and `second` are the columns of position and value.
Result<std::vector<RawReading>> read_rows(std::string_view text, const std::string& file, std::size_t position,
                                          std::size_t value, double um_per_unit) {
  std::vector<RawReading> readings;
  for (const Line& line : lines_of(text)) {
    const auto words = words_of(line.text);
    if (words.size() <= std::max(position, value)) continue;
    const auto x = number_from(words[position]);
    const auto v = number_from(words[value]);
    if (!x && readings.empty()) continue;  // the header
    if (!x || !v) return bad_number(file, line.number, !x ? "position" : "value", !x ? words[position] : words[value]);
    readings.push_back({*x, Approach::up, 1, um_per_unit * *v});
  }
  return readings;
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
  report.machine = rtl.machine;
  report.axis = rtl.axis;
  return report;
}

Result<LaserReport> parse_ren(std::string_view text, const std::string& file, const LaserOptions& options) {
  bool in_mm = false;
  for (const Line& line : lines_of(text)) {
    const bool about_units = line.text.find("nit") != std::string_view::npos;
    if (about_units &&
        (line.text.find("mm") != std::string_view::npos || line.text.find("illim") != std::string_view::npos)) {
      in_mm = true;
    }
  }
  // Rows are "number position combined"; header lines with a single number are shorter.
  ZD_TRY(auto readings, read_rows(text, file, 1, 2, in_mm ? -1000.0 : -1.0));
  ZD_TRY(LaserReport report, assemble(readings, file, options));
  report.warnings.push_back(
      fmt::format("{}: compensation values in {} are taken as -error; confirm sign and unit on one point", file,
                  in_mm ? "mm" : "um"));
  return report;
}

Result<LaserReport> parse_pos(std::string_view text, const std::string& file, const LaserOptions& options) {
  ZD_TRY(auto readings, read_rows(text, file, 0, 1, -1000.0));
  ZD_TRY(LaserReport report, assemble(readings, file, options));
  report.warnings.push_back(fmt::format(
      "{}: values in mm are taken as -error, as the known reader does; confirm the sign on one point", file));
  return report;
}

}  // namespace zerodrift::compensation::laser_parts
