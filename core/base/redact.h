#pragma once
// Takes secrets out of what people and files get to see: the password in a URL, and the values of parameters that are
// secrets by their name. "http://user:pw@cam/?token=1" -> "http://user:***@cam/?token=***".

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace zerodrift {

inline constexpr std::string_view redacted_mark = "***";

/// Any text, with as many URLs as it holds, and values of JSON keys in it that are secrets by their name.
std::string without_secrets(std::string_view text);
/// Every string in a document, and what stands under a key that is a secret by its name (password, token, ...).
nlohmann::json document_without_secrets(const nlohmann::json& document);
/// A URL from which a secret was taken: it leads nowhere any more.
bool lacks_secret(std::string_view url);

}  // namespace zerodrift
