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

/// Numbers the targets; csv-style errors name file and line.
Result<LaserReport> assemble(std::vector<RawReading> readings, const std::string& file, const LaserOptions& options);

Result<LaserReport> parse_csv(std::string_view text, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_rtl(std::string_view text, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_ren(std::string_view text, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_pos(std::string_view text, const std::string& file, const LaserOptions& options);

}  // namespace zerodrift::compensation::laser_parts
