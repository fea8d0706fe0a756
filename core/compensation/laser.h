#pragma once
// Laser interferometer reports (C4): what the axis really did at its targets. Deviation = measured - target = error.
// Read are the contract's CSV forms, Renishaw .rtl (linear), .REN (compensation values), API .pos and plain
// position/error text, in UTF-8, UTF-16 or GBK. Vendors publish no specification of theirs: where a sign or unit had to
// be taken from others' readers, a warning says so and one point is to be confirmed on the machine.

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/compensation/laser_columns.h"
#include "core/compensation/table.h"

namespace zerodrift::compensation {

struct LaserReading {
  std::size_t target = 0;  // index into targets_mm
  Approach approach = Approach::up;
  int run = 1;  // cycle within the direction
  double deviation_um = 0.0;
};

struct LaserReport {
  std::string file;
  std::string machine;             // as far as the report tells
  std::string axis;                // "X", or empty
  std::vector<std::string> axes;   // of a file that holds several
  std::vector<double> targets_mm;  // strictly increasing
  std::vector<LaserReading> readings;
  std::vector<std::string> warnings;

  bool bidirectional() const;
};

struct LaserOptions {
  std::size_t max_points = 20000;              // MAXL: targets of an axis
  std::map<std::string, std::string> columns;  // column in the file -> contract's name
  std::optional<LaserMapping> mapping;         // what the columns are, when that is settled already
  std::string axis;                            // which one, of a file that holds several
  bool negate = false;                         // for a report whose sign turns out to be the other one
};

Result<LaserReport> read_laser(const std::filesystem::path& path, const LaserOptions& options = {});
/// The form is told from content and from the file's extension.
Result<LaserReport> parse_laser(std::string_view bytes, const std::string& file, const LaserOptions& options = {});

/// UTF-8 from UTF-8 (BOM dropped), UTF-16 with BOM, or GBK.
std::string to_utf8(std::string_view bytes);

/// Mean error at each target; directions that were not measured are taken from the other.
std::vector<TablePoint> points_of(const LaserReport& report);

}  // namespace zerodrift::compensation
