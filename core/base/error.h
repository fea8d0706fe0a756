#pragma once
// What a user can meet - a bad file, a dead link, a refused upload - as a value.
// An Error is a code and its context (which file, line, channel, register); it holds no prose for the user:
// the sentence and the remedy are made from both in app/text.

#include <map>
#include <string>
#include <string_view>

namespace zerodrift {

enum class ErrorCode {
#define ZERODRIFT_ERROR(code, keys) code,
#include "core/base/error_codes.inc"
#undef ZERODRIFT_ERROR
};

struct Error {
  ErrorCode code = ErrorCode::internal;
  std::map<std::string, std::string> context;  // key (as in error_codes.inc) -> value; further keys are allowed

  /// The same error with one more fact, kept if the key is already there (the innermost place knows best).
  Error with(std::string key, std::string value) &&;
};

/// The code's identifier, for example "csv_bad_number"; stable, used in logs and JSON.
std::string_view name_of(ErrorCode code);
/// The context keys that the code's sentence uses, separated by blanks.
std::string_view context_keys_of(ErrorCode code);
/// Number of codes; codes are 0 .. count - 1.
int error_code_count();
/// What was found, for a message: as it is, or its beginning where it is long - a whole picture in base64, for example.
std::string shortened(std::string found);
/// One line for logs and test messages: "csv_bad_number file=a.csv line=3".
std::string describe(const Error& error);

}  // namespace zerodrift
