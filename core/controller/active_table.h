#pragma once
// The table a controller works with now.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {

/// machine_unsupported for a controller without a table of its own.
Status require_table(const acquisition::MachineIdentity& identity);

/// By what a controller tells one table from another; a few registers, quick to read.
struct ActiveMark {
  std::uint32_t crc = 0;
  int registers = 0;
  int sequence = 0;
};
Result<ActiveMark> read_active_mark(ModbusMachine& machine);

struct ActiveTable {
  std::vector<std::uint16_t> words;
  int sequence = 0;
  std::uint32_t crc = 0;
};
/// The controller's active table, checked against its CRC.
Result<ActiveTable> read_active(ModbusMachine& machine);

/// The same content; no words at all and the words of the empty table are the same.
bool same_table(std::span<const std::uint16_t> one, std::span<const std::uint16_t> other);

/// No words, or the words of a table without an axis: nothing is compensated.
bool is_empty_table(std::size_t words);
bool is_marked(const ActiveMark& mark, std::span<const std::uint16_t> words);

}  // namespace zerodrift::controller
