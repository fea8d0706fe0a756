#pragma once
// An error in a document, as code and facts: words are made of it where it is read, in the language spoken there.
//   {"code": "not_enough_data", "context": {"what": "...", ...}}

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string_view>

#include "core/base/error.h"

namespace zerodrift {

nlohmann::json to_json(const Error& error);
/// Nothing when it is no error; a code of a newer version becomes ErrorCode::internal with the code as detail.
std::optional<Error> error_from_json(const nlohmann::json& value);
/// The error of which describe() has made this line; nothing for any other text.
std::optional<Error> error_described(std::string_view line);

}  // namespace zerodrift
