#pragma once
// What a person, or a program in a person's place, types on standard input. A question does not outlast the program's
// end: Ctrl+C is noticed within a twentieth of a second, whatever is waited for.

#include <optional>
#include <string>

#include "core/base/result.h"

namespace zerodrift::cli {

/// The next line without its end; nothing when the input is over; cancelled after end_typing().
Result<std::optional<std::string>> typed_line();
/// The same after a question on stderr.
Result<std::optional<std::string>> typed_line(const std::string& question);
/// For a program that is told to end. In all threads, for good.
void end_typing();

}  // namespace zerodrift::cli
