#pragma once
// The same bidirectional test of an axis in the forms that laser systems and spreadsheets write: other separators,
// decimal marks, units, direction words, columns beside the readings, a column for each run, a table for each
// direction. What was measured is known, so a reader gives these figures or refuses.

#include <functional>
#include <string>
#include <vector>

namespace zerodrift::test {

struct AxisReading {
  double target_mm = 0.0;
  bool up = true;
  int run = 1;
  double error_um = 0.0;
};

/// 9 targets from 0 to 400 mm, 3 runs there and back, errors of -4 to 12 um in steps of 0.1 um.
std::vector<AxisReading> axis_readings();

/// One cell of a reading.
using AxisCell = std::function<std::string(const AxisReading&)>;

struct AxisColumn {
  std::string name;
  AxisCell cell;
};

/// A number with so many decimals; `decimal` as the mark.
std::string axis_number(double value, int decimals, char decimal = '.');

AxisColumn axis_target(std::string name, double mm_each = 1.0, int decimals = 3, char decimal = '.');
AxisColumn axis_error(std::string name, double um_each = 1.0, int decimals = 1, char decimal = '.');
AxisColumn axis_measured(std::string name, double mm_each = 1.0, int decimals = 4, char decimal = '.');
AxisColumn axis_direction(std::string name, std::string up, std::string down);
AxisColumn axis_run(std::string name);
AxisColumn axis_words(std::string name, std::string word);

/// A row for each reading, in the order in which the axis was driven.
std::string axis_table(const std::vector<AxisColumn>& columns, const std::string& separator = ";",
                       const std::vector<AxisReading>& readings = axis_readings());
/// A row for each target; `name(up, run)` names the columns of readings.
std::string wide_axis_table(const std::string& target_name, const std::function<std::string(bool, int)>& name,
                            bool measured = false, char decimal = '.');

}  // namespace zerodrift::test
