#pragma once
// A machine behind a register map: acquisition::MachineIo over one Modbus connection. A sample is read in as few
// requests as the map allows. Reads and harmless writes survive the sporadic faults of a device (busy, late, wrong
// transaction, truncated, dropped, byte by byte); they are counted in health().

#include <chrono>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/access/permit.h"
#include "core/acquisition/machine_io.h"
#include "core/controller/link.h"
#include "core/controller/profile.h"
#include "core/controller/register_map.h"

namespace zerodrift::controller {

class ControllerClaim;
class DeviceReadings;

using RegisterValues = std::map<std::string, std::vector<double>>;  // register name -> its values

/// The map a profile brings with it, or names. Of a profile out of a job only a map of the program is read.
Result<RegisterMap> map_of(const Profile& profile, std::vector<std::string>* warnings = nullptr);

class ModbusMachine : public acquisition::MachineIo {
 public:
  /// Loads the profile's register map and starts to ask the rig's devices; the first request connects. Without a permit
  /// to write every write is access_locked before a byte is sent; with one the controller is claimed
  /// (controller_claim.h) until the machine ends.
  static Result<std::unique_ptr<ModbusMachine>> open(const Profile& profile,
                                                     access::Permit permit = access::Permit::read_only());
  /// The control alone.
  ModbusMachine(Profile profile, RegisterMap map, access::Permit permit);
  ~ModbusMachine() override;

  Result<acquisition::MachineIdentity> identify() override;
  Result<acquisition::MachineSample> read() override;
  Status command(double spindle_rpm, bool coolant_on, bool path_cycle) override;
  Status move_to(const std::map<std::string, double>& target_mm) override;
  Status switch_compensation(bool on) override;
  /// Also beats the host heartbeat. interlock_compensation_off while the switch is off.
  Status write_host_offset(const std::array<double, 3>& compensation_um) override;
  /// What the offset registers hold, X Y Z.
  Result<std::array<double, 3>> held_offset_um();
  /// Takes the host offset out of the registers at once, with the switch off as well: 0 compensates nothing. With the
  /// switch on it is no way out, for the axes would jump.
  Status clear_host_offset();
  /// access_locked without a permit to write.
  Status may_write(const std::string& operation) const { return m_permit.check(operation); }

  /// Decoded values of registers of the map, read together.
  Result<RegisterValues> read_values(const std::vector<std::string>& names);
  Result<double> read_value(const std::string& name);
  /// One value, or all values of an array register, in one request.
  Status write_values(const std::string& name, const std::vector<double>& values, Retry retry = Retry::yes);
  /// Raw words of an array register of words (a table area).
  Result<std::vector<std::uint16_t>> read_words(const std::string& name, int count);
  Status write_words(const std::string& name, int offset, std::span<const std::uint16_t> words);
  Result<bool> compensation_on() override;
  Status beat();
  static constexpr double default_watchdog_s = 5.0;  // host seconds
  /// How long the controller waits for a heartbeat before it takes the host offset out. Longer
  /// only where one thread must look away for a while.
  Status set_watchdog(double host_s);
  Result<double> wait_for_ramp(bool on, const std::stop_token& stop = {}) override;

  /// The link's faults that were overcome, its remarks, and those of the rig's devices.
  std::vector<std::string> remarks() const override;
  /// Null where the control reads everything by itself.
  const DeviceReadings* devices() const { return m_devices.get(); }

  const LinkHealth& health() const { return m_link.health(); }
  Link& link() { return m_link; }
  const RegisterMap& map() const { return m_map; }
  const Profile& profile() const { return m_profile; }
  /// Host seconds to wait for so many machine seconds, never less than a few round trips.
  double host_seconds(double machine_seconds) const;

 private:
  Status wait_until_applied(std::chrono::steady_clock::time_point end, const std::stop_token& stop);
  Result<std::vector<std::uint16_t>> read_span(const ReadSpan& span, const std::string& what);
  Status wait_until_zero(const std::string& name, double host_s, const std::string& what);

  Profile m_profile;
  RegisterMap m_map;
  access::Permit m_permit;
  Link m_link;
  std::unique_ptr<ControllerClaim> m_claim;  // null for one that only reads
  std::shared_ptr<DeviceReadings> m_devices;
  bool m_single_reads = false;  // the device refused a read across a gap
  bool m_watchdog_set = false;
  std::uint16_t m_beat = 0;
};

}  // namespace zerodrift::controller
