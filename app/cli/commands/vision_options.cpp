#include "app/cli/commands/vision_options.h"

#include <cmath>

#include "app/cli/command.h"
#include "app/text/error_text.h"

namespace zerodrift::cli {
namespace vision_options {

template <typename Read>
std::string complaint(const Result<Read>& read) {
  return read ? std::string() : lineOf(read.error()).toStdString();
}

}  // namespace vision_options

Result<std::optional<vision::Region>> region_from(const std::string& text, const std::string& option) {
  if (text.empty()) return std::nullopt;
  ZD_TRY(const std::vector<double> n, numbers_from(text, option, 4));
  for (const double value : n) {
    if (std::abs(value) < 1e6 && value == std::floor(value)) continue;
    return fail(ErrorCode::bad_argument, {{"what", option}, {"found", text}, {"expected", "X,Y,W,H in whole pixels"}});
  }
  return vision::Region{static_cast<int>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]), static_cast<int>(n[3])};
}

Result<std::optional<vision::PixelPoint>> point_from(const std::string& text, const std::string& option) {
  if (text.empty()) return std::nullopt;
  ZD_TRY(const std::vector<double> n, numbers_from(text, option, 2));
  return vision::PixelPoint{n[0], n[1]};
}

std::string check_region(const std::string& text) {
  return vision_options::complaint(region_from(text, "region"));
}

std::string check_point(const std::string& text) {
  return vision_options::complaint(point_from(text, "point"));
}

}  // namespace zerodrift::cli
