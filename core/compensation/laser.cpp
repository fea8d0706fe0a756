#include "core/compensation/laser.h"

#include <fmt/format.h>
#include <iconv.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "core/base/file.h"
#include "core/compensation/laser_parts.h"

namespace zerodrift::compensation {
namespace {

constexpr double same_target_mm = 1e-6;

bool is_utf8(std::string_view bytes) {
  for (std::size_t i = 0; i < bytes.size();) {
    const auto lead = static_cast<unsigned char>(bytes[i]);
    const std::size_t more = lead < 0x80 ? 0 : lead >> 5 == 6 ? 1 : lead >> 4 == 14 ? 2 : lead >> 3 == 30 ? 3 : 9;
    if (more == 9 || i + more >= bytes.size() + (more == 0 ? 1 : 0)) return false;
    for (std::size_t k = 1; k <= more; ++k) {
      if ((static_cast<unsigned char>(bytes[i + k]) & 0xC0) != 0x80) return false;
    }
    i += more + 1;
  }
  return true;
}

std::string converted(std::string_view bytes, const char* encoding) {
  const iconv_t converter = ::iconv_open("UTF-8//IGNORE", encoding);
  // NOLINTNEXTLINE(performance-no-int-to-ptr): the error value that POSIX gives it
  if (converter == reinterpret_cast<iconv_t>(-1)) return std::string(bytes);
  std::string input(bytes);
  std::string out(bytes.size() * 3 + 16, '\0');
  char* from = input.data();
  std::size_t from_left = input.size();
  char* to = out.data();
  std::size_t to_left = out.size();
  ::iconv(converter, &from, &from_left, &to, &to_left);
  ::iconv_close(converter);
  out.resize(out.size() - to_left);
  return out;
}

bool has(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

}  // namespace

bool LaserReport::bidirectional() const {
  return std::any_of(readings.begin(), readings.end(),
                     [](const LaserReading& one) { return one.approach == Approach::down; });
}

std::string to_utf8(std::string_view bytes) {
  if (bytes.starts_with("\xEF\xBB\xBF")) return std::string(bytes.substr(3));
  if (bytes.starts_with("\xFF\xFE")) return converted(bytes.substr(2), "UTF-16LE");
  if (bytes.starts_with("\xFE\xFF")) return converted(bytes.substr(2), "UTF-16BE");
  return is_utf8(bytes) ? std::string(bytes) : converted(bytes, "GB18030");  // the superset of GBK
}

Result<LaserReport> parse_laser(std::string_view bytes, const std::string& file, const LaserOptions& options) {
  const std::string text = to_utf8(bytes);
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (options.mapping) return laser_parts::parse_mapped(text, file, *options.mapping, options);
  if (has(text, "DEVIATIONS::") || extension == ".rtl") return laser_parts::parse_rtl(text, file, options);
  if (has(text, "Compensation start") || extension == ".ren") return laser_parts::parse_ren(text, file, options);
  if (has(text, "Bidirectional Avg Error") || extension == ".pos") return laser_parts::parse_pos(text, file, options);
  auto report = laser_parts::parse_csv(text, file, options);
  if (report || !options.columns.empty()) return report;
  // Another maker's table, whose names leave no doubt what the columns are.
  const bool other_form =
      report.error().code == ErrorCode::csv_bad_header || report.error().code == ErrorCode::csv_cell_count;
  if (!other_form) return report;
  const auto preview = preview_laser(bytes, file);
  if (!preview || !preview->certain) return report;
  return laser_parts::parse_mapped(text, file, preview->guess, options);
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
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text = end == std::string_view::npos ? std::string_view{} : text.substr(end + 1);
    const auto first = line.find_first_not_of(" \t\r\f\v");
    const auto last = line.find_last_not_of(" \t\r\f\v");
    line = first == std::string_view::npos ? std::string_view{} : line.substr(first, last - first + 1);
    lines.push_back({++number, line});
  }
  return lines;
}

std::vector<std::string> words_of(std::string_view line) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : line) {
    if (c != ' ' && c != '\t' && c != ';' && c != ',') {
      word += c;
    } else if (!word.empty()) {
      words.push_back(std::move(word));
      word.clear();
    }
  }
  if (!word.empty()) words.push_back(std::move(word));
  return words;
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
