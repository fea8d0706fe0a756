#pragma once
// Options that `calibrate` and `locate` share.

#include <optional>
#include <string>

#include "core/base/result.h"
#include "core/vision/measure_files.h"

namespace zerodrift::cli {

/// "X,Y,W,H" of whole pixels; nothing for an empty text.
Result<std::optional<vision::Region>> region_from(const std::string& text, const std::string& option);
/// "X,Y".
Result<std::optional<vision::PixelPoint>> point_from(const std::string& text, const std::string& option);

}  // namespace zerodrift::cli
