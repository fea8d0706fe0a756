#pragma once
// Laser interferometer reports (C4): what the axis really did at its targets. Deviation = measured - target = error.
// Read are Renishaw .rtl (linear), .REN (compensation values), API .pos, and any table of positions and errors: the
// contract's CSV forms and other makers', in any encoding and with decimal point or comma, as workbooks too. Whatever
// could change a number (unit, scale, sign, direction, order) and is not understood is an error that names line and
// column; what becomes of every other column is listed. Vendors publish no specification of theirs: where a sign or
// unit had to be taken from others' readers, a warning says so and one point is to be confirmed on the machine.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/compensation/laser_columns.h"
#include "core/compensation/table.h"
#include "core/recording/import/header_map.h"

namespace zerodrift::compensation {

struct LaserReading {
  std::size_t target = 0;  // index into targets_mm
  Approach approach = Approach::up;
  int run = 1;  // cycle within the direction
  double deviation_um = 0.0;
};

/// What became of a column: "position in mm", "not used: in %".
struct ColumnFate {
  std::string column;
  std::string fate;
};

struct LaserReport {
  std::string file;
  std::string machine;             // as far as the report tells
  std::string axis;                // "X", or empty
  std::vector<std::string> axes;   // of a file that holds several
  std::vector<double> targets_mm;  // strictly increasing
  std::vector<LaserReading> readings;
  std::vector<ColumnFate> columns;  // of a table: every one
  std::vector<std::string> warnings;

  bool bidirectional() const;
};

struct LaserOptions {
  std::size_t max_points = 20000;              // MAXL: targets of an axis
  std::map<std::string, std::string> columns;  // column in the file -> contract's name
  std::optional<recording::HeaderMap> map;     // what the columns are, as the user says
  std::optional<LaserMapping> mapping;         // what the columns are, when that is settled already
  std::string axis;                            // which one, of a file that holds several
  bool negate = false;                         // for a report whose sign turns out to be the other one
};

Result<LaserReport> read_laser(const std::filesystem::path& path, const LaserOptions& options = {});
/// The form is told from content and from the file's extension.
Result<LaserReport> parse_laser(std::string_view bytes, const std::string& file, const LaserOptions& options = {});

/// Mean error at each target; directions that were not measured are taken from the other.
std::vector<TablePoint> points_of(const LaserReport& report);

}  // namespace zerodrift::compensation
