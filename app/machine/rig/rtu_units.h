#pragma once
// The units of one serial line as Modbus RTU slaves (Modbus over serial line V1.02): registers that are read, by
// function codes 3 and 4 alike, as temperature modules do it. A frame that is spoilt, broadcast or for another unit is
// not answered.

#include <cstdint>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "core/controller/modbus_server.h"

namespace zerodrift::machine {

using RegisterReader = std::function<controller::RegisterReply(int address, int count)>;

class RtuUnits {
 public:
  explicit RtuUnits(std::map<int, RegisterReader> readers) : m_readers(std::move(readers)) {}

  /// The reply, with its CRC, to what arrived between two silences; empty when nobody answers.
  std::vector<std::uint8_t> answer(std::span<const std::uint8_t> frame) const;

 private:
  std::map<int, RegisterReader> m_readers;
};

}  // namespace zerodrift::machine
