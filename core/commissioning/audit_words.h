#pragma once
// What the audit trail keeps of a value, in short: a table's JSON is told by its version.

#include <string>

namespace zerodrift::commissioning {

/// "version 4" of the JSON of a table; any other value as it is.
std::string value_in_short(const std::string& value);

}  // namespace zerodrift::commissioning
