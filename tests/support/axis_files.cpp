#include "tests/support/axis_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace zerodrift::test {
namespace {

constexpr int targets = 9;
constexpr int runs = 3;
constexpr double step_mm = 50.0;

/// A rising error with a wave, 2.6 um of backlash, and runs that scatter by some tenths.
double error_um(int target, bool up, int run) {
  const double x = target / (targets - 1.0);
  const double scatter = 0.1 * ((7 * target + 5 * run + (up ? 0 : 3)) % 7 - 3);
  const double error = 9.0 * x + 2.0 * std::sin(9.0 * x) + (up ? 0.0 : -2.6) + scatter;
  return std::round(10.0 * error) / 10.0;
}

}  // namespace

std::vector<AxisReading> axis_readings() {
  std::vector<AxisReading> out;
  for (int run = 1; run <= runs; ++run) {
    for (int i = 0; i < targets; ++i) out.push_back({step_mm * i, true, run, error_um(i, true, run)});
    for (int i = targets; i-- > 0;) out.push_back({step_mm * i, false, run, error_um(i, false, run)});
  }
  return out;
}

std::string axis_number(double value, int decimals, char decimal) {
  std::string text = fmt::format("{:.{}f}", value, decimals);
  std::replace(text.begin(), text.end(), '.', decimal);
  return text;
}

AxisColumn axis_target(std::string name, double mm_each, int decimals, char decimal) {
  return {std::move(name), [=](const AxisReading& r) { return axis_number(r.target_mm / mm_each, decimals, decimal); }};
}

AxisColumn axis_error(std::string name, double um_each, int decimals, char decimal) {
  return {std::move(name), [=](const AxisReading& r) { return axis_number(r.error_um / um_each, decimals, decimal); }};
}

AxisColumn axis_measured(std::string name, double mm_each, int decimals, char decimal) {
  return {std::move(name), [=](const AxisReading& r) {
            return axis_number((r.target_mm + 1e-3 * r.error_um) / mm_each, decimals, decimal);
          }};
}

AxisColumn axis_direction(std::string name, std::string up, std::string down) {
  return {std::move(name), [=](const AxisReading& r) { return r.up ? up : down; }};
}

AxisColumn axis_run(std::string name) {
  return {std::move(name), [](const AxisReading& r) { return std::to_string(r.run); }};
}

AxisColumn axis_words(std::string name, std::string word) {
  return {std::move(name), [=](const AxisReading&) { return word; }};
}

std::string axis_table(const std::vector<AxisColumn>& columns, const std::string& separator,
                       const std::vector<AxisReading>& readings) {
  std::string out;
  for (std::size_t k = 0; k < columns.size(); ++k) out += (k == 0 ? "" : separator) + columns[k].name;
  out += "\n";
  for (const AxisReading& reading : readings) {
    for (std::size_t k = 0; k < columns.size(); ++k) out += (k == 0 ? "" : separator) + columns[k].cell(reading);
    out += "\n";
  }
  return out;
}

std::string wide_axis_table(const std::string& target_name, const std::function<std::string(bool, int)>& name,
                            bool measured, char decimal) {
  std::string out = target_name;
  for (int run = 1; run <= runs; ++run) {
    for (const bool up : {true, false}) out += ";" + name(up, run);
  }
  for (int i = 0; i < targets; ++i) {
    out += "\n" + axis_number(step_mm * i, 3, decimal);
    for (int run = 1; run <= runs; ++run) {
      for (const bool up : {true, false}) {
        const double um = error_um(i, up, run);
        out += ";" + (measured ? axis_number(step_mm * i + 1e-3 * um, 4, decimal) : axis_number(um, 1, decimal));
      }
    }
  }
  return out + "\n";
}

}  // namespace zerodrift::test
