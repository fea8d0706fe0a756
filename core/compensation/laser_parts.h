#pragma once
// Shared by the readers of laser reports; not for others.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/compensation/laser.h"

namespace zerodrift::compensation::laser_parts {

/// One deviation as the file gives it, before targets are numbered.
struct RawReading {
  double target_mm = 0.0;
  Approach approach = Approach::up;
  int run = 1;
  double deviation_um = 0.0;
};

struct Line {
  int number = 0;
  std::string_view text;  // trimmed
};
std::vector<Line> lines_of(std::string_view text);
std::vector<std::string> words_of(std::string_view line);
std::optional<double> number_from(std::string_view word);
/// Cells between separators, trimmed; ' ' parts at blanks and tabs.
std::vector<std::string> cells_of_line(std::string_view line, char separator);
std::optional<double> number_in_cell(std::string cell, bool decimal_comma);
/// Whole and not below 0; nothing for a number that names no run.
std::optional<int> run_number(double value);
/// ASCII letters in lower case.
std::string lowered(std::string text);
/// "up", "forward", "+1", ...; nothing for a word that is no direction.
std::optional<Approach> approach_word(std::string word);

/// Numbers the targets; csv-style errors name file and line.
Result<LaserReport> assemble(const std::vector<RawReading>& readings, const std::string& file,
                             const LaserOptions& options);

Result<LaserReport> parse_csv(std::string_view text, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_mapped(std::string_view text, const std::string& file, const LaserMapping& mapping,
                                 const LaserOptions& options);
Result<LaserReport> parse_rtl(std::string_view text, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_ren(std::string_view text, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_pos(std::string_view text, const std::string& file, const LaserOptions& options);

}  // namespace zerodrift::compensation::laser_parts
