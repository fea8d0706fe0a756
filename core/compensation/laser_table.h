#pragma once
// The tables of numbers in a file of an axis: one, or one for each direction, run or axis; each with its header, the
// lines between header and numbers (units, directions) and the lines above it. Shared by the readers of laser reports;
// not for others.

#include <string>
#include <vector>

#include "core/compensation/laser_words.h"
#include "core/recording/import/cells.h"

namespace zerodrift::compensation::laser_parts {

struct LaserBlock {
  std::vector<std::string> titles;  // lines above the header that belong to no table; the nearest last
  std::vector<ColumnName> columns;  // as the header, the units row and the like say; empty: there is no header
  std::vector<std::size_t> rows;    // of the cells
  std::size_t width = 0;            // cells of a row
  int header_line = 0;              // 0: none
  bool inherited = false;           // its header is that of the table before
};

/// Every table of at least one row. csv_cell_count where a row has other cells than the rows before it;
/// column_unclear where header and units row contradict each other.
Result<std::vector<LaserBlock>> blocks_of(const recording::Cells& cells, const std::string& file);

/// Anything in a table that could change a number and is not understood.
tl::unexpected<Error> unclear(const std::string& file, int line, const std::string& column, const std::string& found,
                              const std::string& expected);

}  // namespace zerodrift::compensation::laser_parts
