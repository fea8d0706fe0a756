#include "core/controller/devices/modbus_device.h"

#include <fmt/format.h>

#include <charconv>
#include <set>

#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {
namespace {

struct Wanted {
  std::string name;       // of a register
  std::size_t index = 0;  // of its values
};

/// "temperature_C[3]" is the third value; without brackets the first.
Result<Wanted> wanted_of(const std::string& signal, const RegisterMap& map) {
  const std::size_t bracket = signal.find('[');
  Wanted wanted{signal.substr(0, bracket), 0};
  ZD_TRY(const Register entry, map.require(wanted.name));
  if (bracket == std::string::npos) return wanted;
  int number = 0;
  const char* end = signal.data() + signal.size();
  const auto [stop, error] = std::from_chars(signal.data() + bracket + 1, end, number);
  if (error != std::errc() || stop + 1 != end || *stop != ']' || number < 1 || number > entry.count) {
    return fail(ErrorCode::data_does_not_fit, {{"what", "signal " + signal},
                                               {"found", signal.substr(bracket)},
                                               {"expected", fmt::format("[1] to [{}]", entry.count)}});
  }
  wanted.index = static_cast<std::size_t>(number - 1);
  return wanted;
}

class ModbusDevice : public Device {
 public:
  ModbusDevice(Profile profile, RegisterMap map, std::vector<Wanted> wanted)
      : m_machine(std::move(profile), std::move(map), access::Permit::read_only()), m_wanted(std::move(wanted)) {
    m_machine.link().set_attempts(1);
    std::set<std::string> names;
    for (const Wanted& one : m_wanted) names.insert(one.name);
    m_names.assign(names.begin(), names.end());
  }

  Result<std::vector<Reading>> read() override {
    const Seconds begun = host_clock().steady();
    ZD_TRY(const RegisterValues values, m_machine.read_values(m_names));
    const Seconds at = 0.5 * (begun + host_clock().steady());
    std::vector<Reading> readings;
    for (const Wanted& one : m_wanted) readings.push_back({values.at(one.name).at(one.index), at});
    return readings;
  }

  std::vector<std::string> remarks() const override { return m_machine.health().remarks; }

 private:
  ModbusMachine m_machine;
  std::vector<Wanted> m_wanted;
  std::vector<std::string> m_names;
};

}  // namespace

Result<std::unique_ptr<Device>> open_modbus(const DeviceProfile& profile, const std::vector<std::string>& signals) {
  Profile alone;
  alone.name = profile.id;
  alone.file = profile.file;
  alone.of_job = profile.of_job;
  alone.controller = profile.modbus;
  ZD_TRY(RegisterMap map, map_of(alone));
  std::vector<Wanted> wanted;
  for (const std::string& signal : signals) {
    ZD_TRY(wanted.emplace_back(), wanted_of(signal, map));
  }
  return std::make_unique<ModbusDevice>(std::move(alone), std::move(map), std::move(wanted));
}

}  // namespace zerodrift::controller
