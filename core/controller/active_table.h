#pragma once
// The table a controller works with now.

#include <cstdint>
#include <span>
#include <vector>

#include "core/base/result.h"
#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {

struct ActiveTable {
  std::vector<std::uint16_t> words;
  int sequence = 0;
  std::uint32_t crc = 0;
};
/// The controller's active table, checked against its CRC.
Result<ActiveTable> read_active(ModbusMachine& machine);

/// The same content; no words at all and the words of the empty table are the same.
bool same_table(std::span<const std::uint16_t> one, std::span<const std::uint16_t> other);

}  // namespace zerodrift::controller
