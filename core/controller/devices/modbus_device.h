#pragma once
// A module, an amplifier, a PLC that is only read, over Modbus TCP or RTU. Signals are registers of its map:
// "ambient_C", or "temperature_C[3]" for the third value of an array. One request a round and no second try: the line
// is shared, and the next round is the second try.

#include "core/controller/devices/device.h"

namespace zerodrift::controller {

/// machine_register_unknown for a signal that the map has not; its value is at the middle of the request.
Result<std::unique_ptr<Device>> open_modbus(const DeviceProfile& profile, const std::vector<std::string>& names);

}  // namespace zerodrift::controller
