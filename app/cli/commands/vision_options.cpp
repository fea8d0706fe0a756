#include "app/cli/commands/vision_options.h"

#include <cmath>

#include "app/cli/command.h"

namespace zerodrift::cli {

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

}  // namespace zerodrift::cli
