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

/// As a check of the option: a text that is none is wrong usage, not a failure on the data.
std::string check_region(const std::string& text);
std::string check_point(const std::string& text);

}  // namespace zerodrift::cli
