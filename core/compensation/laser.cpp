#include "core/compensation/laser.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "core/base/file.h"
#include "core/compensation/laser_parts.h"
#include "core/recording/import/cells.h"
#include "core/recording/import/text_decoding.h"

namespace zerodrift::compensation {
namespace {

constexpr double same_target_mm = 1e-6;

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace

bool LaserReport::bidirectional() const {
  return std::any_of(readings.begin(), readings.end(),
                     [](const LaserReading& one) { return one.approach == Approach::down; });
}

Result<LaserReport> parse_laser(std::string_view bytes, const std::string& file, const LaserOptions& options) {
  const std::string extension = laser_parts::lowered(std::filesystem::path(file).extension().string());
  if (options.mapping) return laser_parts::parse_mapped(bytes, file, *options.mapping, options);
  if (extension == ".rta" || extension == ".rtr") {
    return fail(ErrorCode::wrong_format, {{"file", file},
                                          {"found", "a report of a rotary axis"},
                                          {"expected", "one of a linear axis; rotary axes are not compensated"}});
  }
  if (bytes.starts_with("PK")) return laser_parts::parse_tables(bytes, file, options);
  ZD_TRY(const auto decoded, recording::decode_text(bytes, file));
  const std::string& text = decoded.text;
  if (has(text, "DEVIATIONS::") || extension == ".rtl") return laser_parts::parse_rtl(text, file, options);
  // Of a file whose columns the user names no other form is told by its look.
  if (options.map) return laser_parts::parse_tables(bytes, file, options);
  if (has(text, "Compensation start") || extension == ".ren") return laser_parts::parse_ren(text, file, options);
  if (has(text, "Bidirectional Avg Error") || extension == ".pos") return laser_parts::parse_pos(text, file, options);
  return laser_parts::parse_tables(bytes, file, options);
}

Result<LaserReport> read_laser(const std::filesystem::path& path, const LaserOptions& options) {
  ZD_TRY(const std::string bytes, read_file(path, std::size_t{256} << 20));
  return parse_laser(bytes, path.string(), options);
}

std::vector<TablePoint> points_of(const LaserReport& report) {
  struct Sum {
    double um = 0.0;
    int count = 0;
  };
  std::vector<std::array<Sum, 2>> sums(report.targets_mm.size());
  for (const auto& one : report.readings) {
    Sum& sum = sums[one.target][one.approach == Approach::up ? 0 : 1];
    sum.um += one.deviation_um;
    ++sum.count;
  }
  std::vector<TablePoint> points;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const auto mean = [&](std::size_t side) {
      const Sum& own = sums[i][side].count > 0 ? sums[i][side] : sums[i][1 - side];
      return own.um / own.count;
    };
    points.push_back({report.targets_mm[i], mean(0), mean(1), 0.0});
  }
  return points;
}

namespace laser_parts {

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  int number = 0;
  while (!text.empty()) {
    const std::size_t end = text.find_first_of("\r\n");
    const std::string_view line = text.substr(0, end);
    const bool both = end != std::string_view::npos && text.substr(end).starts_with("\r\n");
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + (both ? 2 : 1));
    lines.push_back({++number, recording::trimmed(line)});
  }
  return lines;
}

std::string lowered(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return c < 0x80 ? static_cast<char>(std::tolower(c)) : static_cast<char>(c); });
  return text;
}

std::optional<int> run_number(double value) {
  constexpr double most_runs = 1e6;  // a number beyond names no run
  if (value < 0.0 || value > most_runs || value != std::floor(value)) return {};
  return static_cast<int>(value);
}

std::optional<double> number_from(std::string_view word) {
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

Result<LaserReport> assemble(const std::vector<RawReading>& readings, const std::string& file,
                             const LaserOptions& options) {
  LaserReport report;
  report.file = file;
  for (const auto& one : readings) report.targets_mm.push_back(one.target_mm);
  std::sort(report.targets_mm.begin(), report.targets_mm.end());
  const auto same = [](double a, double b) { return std::abs(a - b) < same_target_mm; };
  report.targets_mm.erase(std::unique(report.targets_mm.begin(), report.targets_mm.end(), same),
                          report.targets_mm.end());
  if (report.targets_mm.size() < 2) {
    return fail(ErrorCode::not_enough_data,
                {{"what", "targets in " + file}, {"found", std::to_string(report.targets_mm.size())}, {"needed", "2"}});
  }
  if (report.targets_mm.size() > options.max_points) {
    return fail(ErrorCode::limit_exceeded, {{"what", "the number of targets in " + file},
                                            {"found", std::to_string(report.targets_mm.size())},
                                            {"limit", std::to_string(options.max_points)}});
  }
  for (const auto& one : readings) {
    const auto at =
        std::lower_bound(report.targets_mm.begin(), report.targets_mm.end(), one.target_mm - same_target_mm);
    report.readings.push_back({static_cast<std::size_t>(at - report.targets_mm.begin()), one.approach, one.run,
                               options.negate ? -one.deviation_um : one.deviation_um});
  }
  return report;
}

}  // namespace laser_parts
}  // namespace zerodrift::compensation
