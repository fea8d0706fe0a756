#pragma once
// What the Modbus parts of the rig beside the control hold: two temperature modules of eight channels and the probe
// amplifier, as their shipped register maps say (resources/register_maps).

#include "app/machine/live_machine.h"

namespace zerodrift::machine {

inline constexpr int module_channels = 8;

/// temperature-module-8-pt100: registers 0 to 7 are sensors first_sensor and on, int16 in 0.01 C, 0x8000 for a broken
/// wire.
controller::RegisterReply read_temperature_module(LiveMachine& machine, int first_sensor, int address, int count);
/// probe-amplifier: register 0 is 1 while the probes see the nose, 2 to 11 are X1 X2 Y1 Y2 Z, float32 in um; not a
/// number out of their range.
controller::RegisterReply read_probe_amplifier(LiveMachine& machine, int address, int count);

}  // namespace zerodrift::machine
