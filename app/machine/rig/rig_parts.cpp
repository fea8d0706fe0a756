#include "app/machine/rig/rig_parts.h"

#include "app/machine/rig/agent_server.h"
#include "app/machine/rig/operator_endpoint.h"
#include "app/machine/rig/rig_registers.h"
#include "app/machine/rig/serial_line.h"

namespace zerodrift::machine {

struct RigParts::Parts {
  RigEndpoints endpoints;
  std::unique_ptr<SerialLine> modules;
  std::unique_ptr<controller::ModbusServer> amplifier;
  std::unique_ptr<AgentServer> agent;
  std::unique_ptr<TemperaturePublisher> publisher;
  std::unique_ptr<OperatorEndpoint> operator_endpoint;
};

namespace {

RtuUnits two_modules(LiveMachine& machine) {
  const auto module_from = [&machine](int first_sensor) -> RegisterReader {
    return [&machine, first_sensor](int address, int count) {
      return read_temperature_module(machine, first_sensor, address, count);
    };
  };
  return RtuUnits({{1, module_from(1)}, {2, module_from(1 + module_channels)}});
}

controller::ModbusServerOptions amplifier_options(LiveMachine& machine) {
  controller::ModbusServerOptions options;
  options.read = [&machine](int address, int count) { return read_probe_amplifier(machine, address, count); };
  options.write = [](int, std::span<const std::uint16_t>) { return controller::ModbusException::illegal_address; };
  return options;
}

}  // namespace

RigParts::RigParts(std::unique_ptr<Parts> parts) : m_parts(std::move(parts)) {}
RigParts::~RigParts() = default;

const RigEndpoints& RigParts::endpoints() const {
  return m_parts->endpoints;
}

Result<std::unique_ptr<RigParts>> RigParts::start(LiveMachine& machine, const RigOptions& options) {
  auto parts = std::make_unique<Parts>();
  ZD_TRY(parts->modules, SerialLine::open(two_modules(machine)));
  parts->endpoints.serial_line = parts->modules->path();
  ZD_TRY(parts->amplifier, controller::ModbusServer::start(amplifier_options(machine)));
  parts->endpoints.amplifier_port = parts->amplifier->port();
  ZD_TRY(parts->agent, AgentServer::start(machine, options.machine_second_s));
  parts->endpoints.agent_port = parts->agent->port();
  if (options.broker) {
    parts->publisher = std::make_unique<TemperaturePublisher>(machine, *options.broker, options.machine_second_s);
    parts->endpoints.broker_host = options.broker->host;
    parts->endpoints.broker_port = options.broker->port;
  }
  if (options.manual_control) {
    ZD_TRY(parts->operator_endpoint, OperatorEndpoint::start(machine));
    parts->endpoints.operator_port = parts->operator_endpoint->port();
  }
  return std::unique_ptr<RigParts>(new RigParts(std::move(parts)));
}

}  // namespace zerodrift::machine
