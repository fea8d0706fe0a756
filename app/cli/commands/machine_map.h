#pragma once
// Subcommands of `machine` about register maps.

#include "app/cli/command.h"

namespace zerodrift::cli {

struct MapOptions {
  std::string list;  // CSV or JSON
  std::string name;
  std::string out;
  std::string profile;
  int base = -1;  // of plain addresses in a list: 0 or 1; -1: as the list says, else 0
};

/// A map file from a list of registers, and what it is good for.
Result<CommandOutput> make_map(const MapOptions& options);
/// Every register of the connected controller, decoded.
Result<CommandOutput> list_registers(const MapOptions& options);

}  // namespace zerodrift::cli
