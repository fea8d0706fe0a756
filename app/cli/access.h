#pragma once
// The engineer's PIN on the command line: commands that write to a machine ask for it where one is set.

#include <memory>

#include "app/cli/command.h"
#include "core/access/access.h"

namespace zerodrift::cli {

struct PinOption {
  std::string file;  // its first line is the PIN
};

/// Adds --pin-file (also from ZERODRIFT_PIN_FILE).
std::shared_ptr<PinOption> add_pin_option(CLI::App& command);
/// First line of the file, or typed without echo on a terminal; access_locked with neither.
Result<std::string> pin_from(const std::string& file, const std::string& question, const std::string& operation);
/// The right to write. Without a PIN on this computer nothing is asked.
Result<access::Permit> engineer(const PinOption& option, const std::string& operation);

}  // namespace zerodrift::cli
