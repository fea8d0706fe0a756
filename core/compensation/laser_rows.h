#pragma once
// Rows of planned tables into readings, and the checks that need the readings: one column against another that says the
// same, and directions against the order of the positions. Shared by the readers of laser reports; not for others.

#include "core/compensation/laser_parts.h"
#include "core/compensation/laser_plan.h"

namespace zerodrift::compensation::laser_parts {

struct PlannedTable {
  LaserBlock block;
  TablePlan plan;
};

struct ReadRows {
  std::vector<RawReading> readings;
  std::vector<std::string> axes;  // of a file with a column of axes
  std::string axis;               // the one that was read
  bool from_order = false;        // directions are those in which the positions were driven
};

/// Every reading of the tables; csv_bad_number, column_unclear and data_does_not_fit name line and column.
Result<ReadRows> read_rows(const std::vector<PlannedTable>& tables, const LaserCells& file,
                           const LaserOptions& options);

}  // namespace zerodrift::compensation::laser_parts
