#pragma once
// Which columns of a table are the positions, the readings, the direction and the run, in which units; and what becomes
// of every other column. Shared by the readers of laser reports; not for others.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/compensation/laser.h"
#include "core/compensation/laser_table.h"
#include "core/recording/import/number_format.h"

namespace zerodrift::compensation::laser_parts {

/// A column of positions or errors: number in the file -> mm or um.
struct PlannedColumn {
  std::size_t at = 0;
  double scale = 1.0;
  double offset = 0.0;
  bool measured = false;             // an actual position, in mm; else an error, in um
  std::optional<Approach> approach;  // nothing: as the row says
  std::optional<int> run;
};

struct TablePlan {
  PlannedColumn target;
  std::vector<PlannedColumn> values;
  std::vector<PlannedColumn> same;  // further columns of the same readings; they are compared with `values`
  std::optional<std::size_t> direction;
  std::optional<std::size_t> run;
  std::optional<std::size_t> axis;
  std::vector<std::size_t> validity;
  std::optional<Approach> approach;  // of the whole table
  std::optional<int> table_run;
  bool direction_from_order = false;  // settled by the user; else found from the rows
  bool mean_of_both = false;          // readings are means of both directions
};

/// The cells of the file in their number format.
struct LaserCells {
  const recording::Cells& cells;
  const recording::NumberFormat& numbers;
  const std::string& file;

  std::optional<double> number(std::size_t row, std::size_t column) const {
    return numbers.number(cells.at(row, column));
  }
};

/// What the table's own names say. Any name, unit, sign or direction that could change a number and is not understood
/// is an error; `fates` gets a line for each column that is not read.
Result<TablePlan> plan_of(const LaserBlock& block, const LaserCells& file, std::vector<ColumnFate>& fates);

/// "#3" where the column has no name.
std::string label_of(const LaserBlock& block, std::size_t column);

}  // namespace zerodrift::compensation::laser_parts
