#pragma once
// Looking for devices, only when asked: the serial ports of this computer, Modbus units on a port, and the own local
// network. Each search says what it finds at once and can be ended.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/base/task_context.h"
#include "core/controller/device_profile.h"

namespace zerodrift::controller {

struct SerialPort {
  std::string path;    // for a profile: the name that stays where the adapter has one
  std::string device;  // "/dev/ttyUSB0"
};
/// Ports with a device behind them; `folder` stands for /dev.
std::vector<SerialPort> serial_ports(const std::filesystem::path& folder = "/dev");

struct FoundUnit {
  int unit = 0;
  double round_trip_s = 0.0;
};
inline constexpr int first_unit = 1;
inline constexpr int last_unit = 247;  // Modbus over serial line V1.02, clause 2.2
/// Units that answer at this port or address, a refusal being an answer too. The time-out of `line` is for each unit.
Status find_units(ControllerSettings line, int first, int last, const TaskContext& context,
                  const std::function<void(const FoundUnit&)>& found);

struct HostPort {
  std::string host;
  int port = 0;
};
inline constexpr int modbus_port = 502;
inline constexpr int agent_port = 5000;
/// Both ports at each address of the networks that this computer is in, loopback excluded: of a large network the 254
/// neighbours, of at most four networks.
std::vector<HostPort> own_network();
/// Those where something listens.
Status find_listeners(const std::vector<HostPort>& addresses, const TaskContext& context,
                      const std::function<void(const HostPort&)>& found);

}  // namespace zerodrift::controller
