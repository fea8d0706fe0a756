#pragma once
// An error in a document, as code and facts: words are made of it where it is read, in the language spoken there.
//   {"code": "not_enough_data", "context": {"what": "...", ...}}

#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "core/base/error.h"

namespace zerodrift {

nlohmann::json to_json(const Error& error);
/// Nothing when it is no error; a code of a newer version becomes ErrorCode::internal with the code as detail.
std::optional<Error> error_from_json(const nlohmann::json& value);

}  // namespace zerodrift
