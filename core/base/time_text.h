#pragma once
// UTC stamps as text: ISO 8601 with milliseconds and Z, for example 2026-11-20T10:15:30.250Z. Files hold nothing else.

#include <string>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace zerodrift {

std::string to_text(UtcTime time);
Result<UtcTime> utc_from_text(const std::string& text);

}  // namespace zerodrift
