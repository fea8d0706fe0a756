#pragma once
// Shared by the readers of laser reports; not for others.

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/compensation/laser.h"

namespace zerodrift::compensation::laser_parts {

inline constexpr double um_per_mm = 1000.0;

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
/// Lines end in LF, CR LF or CR.
std::vector<Line> lines_of(std::string_view text);
/// A number with a decimal point, nothing around it but a "+".
std::optional<double> number_from(std::string_view word);
/// Whole and not below 0; nothing for a number that names no run.
std::optional<int> run_number(double value);
/// ASCII letters in lower case.
std::string lowered(std::string text);
/// Numbers the targets; csv-style errors name file and line.
Result<LaserReport> assemble(const std::vector<RawReading>& readings, const std::string& file,
                             const LaserOptions& options);

/// Any table: what its columns are is told by its names, or was settled.
Result<LaserReport> parse_tables(std::string_view bytes, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_mapped(std::string_view bytes, const std::string& file, const LaserMapping& mapping,
                                 const LaserOptions& options);
Result<LaserReport> parse_rtl(std::string_view text, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_ren(std::string_view text, const std::string& file, const LaserOptions& options);
Result<LaserReport> parse_pos(std::string_view text, const std::string& file, const LaserOptions& options);

}  // namespace zerodrift::compensation::laser_parts
