#pragma once
// docs/register-map.md, version 1, laid over the machine. Every request sees one moment of it and is done whole or not
// at all.

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "app/machine/machine.h"
#include "core/controller/modbus_server.h"

namespace zerodrift::machine {

enum class RegisterScope {
  whole_machine,
  control_alone,  // temperatures and probes are devices of their own (virtual-rig-control)
};

class RegisterBank {
 public:
  RegisterBank(Machine& machine, std::uint32_t serial, int time_factor,
               RegisterScope scope = RegisterScope::whole_machine);

  std::uint32_t serial() const { return m_serial; }
  void set_time_factor(int time_factor) { m_time_factor = time_factor; }
  controller::RegisterReply read(int address, int count) const;
  std::optional<controller::ModbusException> write(int address, std::span<const std::uint16_t> words);

 private:
  struct Field;
  static std::span<const Field> fields();
  static const Field* field_at(int address);
  std::optional<controller::ModbusException> check(int address, std::span<const std::uint16_t> words) const;
  bool holds(int address, int count) const;
  std::vector<std::uint16_t> image() const;

  Machine& m_machine;
  std::uint32_t m_serial;
  int m_time_factor;
  RegisterScope m_scope;
  std::uint16_t m_host_beat = 0;
  Axes m_target_mm{};
};

}  // namespace zerodrift::machine
