#pragma once
// Base64 (RFC 4648) for bytes in JSON.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace zerodrift {

std::string base64_of(std::span<const std::uint8_t> bytes);
/// Nothing when the text is not base64.
std::optional<std::vector<std::uint8_t>> from_base64(std::string_view text);

}  // namespace zerodrift
