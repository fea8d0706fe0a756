#include "app/machine/rig/rig_registers.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/machine/compensation_table.h"

namespace zerodrift::machine {
namespace {

constexpr double reading_C = 1.0 / 16.0;      // of the machine's own conversion
constexpr double module_resolution_C = 0.01;  // int16 holds 327 C of them
constexpr std::uint16_t module_missing = 0x8000;
constexpr int first_probe_register = 2;

controller::RegisterReply part_of(const std::vector<std::uint16_t>& words, int address, int count) {
  if (address + count > static_cast<int>(words.size())) {
    return tl::unexpected(controller::ModbusException::illegal_address);
  }
  return std::vector<std::uint16_t>(words.begin() + address, words.begin() + address + count);
}

}  // namespace

controller::RegisterReply read_temperature_module(LiveMachine& machine, int first_sensor, int address, int count) {
  std::vector<std::uint16_t> words(module_channels);
  machine.with([&](const Machine& now) {
    for (int i = 0; i < module_channels; ++i) {
      const std::int16_t raw = now.raw_temperature(first_sensor + i);
      const auto hundredths = std::lround(raw * reading_C / module_resolution_C);
      words[i] = raw == dead_reading ? module_missing : static_cast<std::uint16_t>(hundredths);
    }
  });
  return part_of(words, address, count);
}

controller::RegisterReply read_probe_amplifier(LiveMachine& machine, int address, int count) {
  std::vector<std::uint16_t> words(first_probe_register);
  machine.with([&](const Machine& now) {
    const bool seen = now.at_nest();
    words[0] = seen ? 1 : 0;
    for (const double um : now.probes_um()) {
      const auto pair = words_of(seen ? static_cast<float>(um) : std::numeric_limits<float>::quiet_NaN());
      words.insert(words.end(), pair.begin(), pair.end());
    }
  });
  return part_of(words, address, count);
}

}  // namespace zerodrift::machine
