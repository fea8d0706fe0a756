#pragma once
// What may leave the house: texts without passwords. Profiles and addresses of cameras can hold them.

#include <string>
#include <string_view>

namespace zerodrift {

inline constexpr std::string_view removed_secret = "removed";

/// The text with every secret replaced: names and passwords in addresses ("rtsp://user:pw@host"), values of address
/// parameters ("?token=..."), and values of JSON keys that name a password, a secret, a token or a key to an interface.
std::string without_secrets(std::string_view text);

}  // namespace zerodrift
