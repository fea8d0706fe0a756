#pragma once
// Position and error tables of unknown make: what is in their columns is guessed from names, units and numbers, shown,
// and settled by the user. A mapping once settled can be kept as text and used for the next file of that make.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::compensation {

enum class LaserColumn {
  ignored,
  position,    // target
  error,       // actual - commanded
  error_up,    // of the approach towards greater positions; several columns are several runs
  error_down,  // of the other approach
  measured,    // actual position
  measured_up,
  measured_down,
  direction,  // a word for the approach
  run,
};
std::string_view name_of(LaserColumn column);  // "error_up"
constexpr bool is_error(LaserColumn column) {
  return column == LaserColumn::error || column == LaserColumn::error_up || column == LaserColumn::error_down;
}
constexpr bool is_measured(LaserColumn column) {
  return column == LaserColumn::measured || column == LaserColumn::measured_up || column == LaserColumn::measured_down;
}

struct LaserMapping {
  char separator = ',';              // ' ': blanks and tabs
  int first_line = 1;                // of the numbers, from 1
  std::vector<LaserColumn> columns;  // from the left
  double mm_per_position = 1.0;      // unit of positions and measured positions
  double um_per_error = 1.0;         // unit of errors
  bool decimal_comma = false;
  bool negated = false;               // the file holds compensations, or commanded - actual
  bool direction_from_order = false;  // rows towards greater positions are upwards, the others downwards
};

struct LaserPreview {
  std::string encoding;            // "UTF-8", "UTF-16", "GBK"
  std::vector<std::string> names;  // of the columns; empty where the file names none
  std::vector<std::vector<std::string>> rows;
  LaserMapping guess;
  bool certain = false;  // position and value both have names that say so
};

/// not_enough_data when no table of numbers is found.
Result<LaserPreview> preview_laser(std::string_view bytes, const std::string& file);

/// Names that files of the same make share: under this a settled mapping is kept.
std::string signature_of(const LaserPreview& preview);
std::string text_of(const LaserMapping& mapping);
/// Nothing when the text is no mapping for a table of that many columns.
std::optional<LaserMapping> mapping_from_text(const std::string& text, std::size_t columns);
/// In words, for a warning: "column 1 is the position in mm, column 3 the error in um".
std::string describe(const LaserMapping& mapping);

}  // namespace zerodrift::compensation
