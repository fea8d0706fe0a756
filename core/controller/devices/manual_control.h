#pragma once
// A control without a link: a person moves the machine when asked, and everything that can be read comes from the
// rig's devices. Positions, speed, coolant and switch are as the person confirmed them, unless a device says them; the
// clock is this computer's. What the camera can see of a move is checked by those who measure.

#include <memory>
#include <optional>

#include "core/access/permit.h"
#include "core/acquisition/machine_io.h"
#include "core/controller/device_readings.h"
#include "core/controller/operator.h"
#include "core/controller/profile.h"

namespace zerodrift::controller {

class ManualControl : public acquisition::MachineIo {
 public:
  /// operator_missing without a person. Starts to ask the rig's devices.
  static Result<std::unique_ptr<ManualControl>> open(const Profile& profile, std::shared_ptr<Operator> person,
                                                     access::Permit permit);

  Result<acquisition::MachineIdentity> identify() override;
  Result<acquisition::MachineSample> read() override;
  /// Nothing is asked when nothing changes. A path that stops before a move is asked for with the move.
  Status command(double spindle_rpm, bool coolant_on, bool path_cycle) override;
  Status move_to(const std::map<std::string, double>& target_mm) override;
  Status switch_compensation(bool on) override;
  Result<bool> compensation_on() override;
  /// The control tells nothing: the time its profile's rate takes for its largest compensation.
  Result<double> wait_for_ramp(bool on, const std::stop_token& stop) override;
  /// interlock_compensation_off while the switch is off.
  Status write_host_offset(const std::array<double, 3>& compensation_um) override;
  bool by_hand() const override { return true; }
  const Profile& profile() const { return m_profile; }
  std::vector<std::string> remarks() const override;
  /// Null where nothing is read.
  const DeviceReadings* devices() const { return m_devices.get(); }

  /// The table in the file becomes the control's; upload_read_back unless the person reads off the same check value.
  Status load_table(const std::string& file, const std::string& check);
  /// The check value of the table that is active, as the person reads it off.
  Result<std::string> table_check();

 private:
  ManualControl(Profile profile, std::shared_ptr<Operator> person, access::Permit permit);
  Status know_state();

  Profile m_profile;
  std::shared_ptr<Operator> m_person;
  access::Permit m_permit;
  std::shared_ptr<DeviceReadings> m_devices;
  struct Command {
    double spindle_rpm = 0.0;
    bool coolant_on = false;
    bool path_cycle = false;
    bool operator==(const Command&) const = default;
  };
  std::optional<Command> m_done;  // as the person confirmed it last
  Command m_wanted;               // differs from m_done by a path that is to stop
  std::map<std::string, double> m_position_mm;
  bool m_elsewhere = true;  // the path ran since the last move
  std::optional<bool> m_compensation_on;
  std::array<double, 3> m_offset_um{};
  Seconds m_changed{0.0};  // host time at which what is applied was last changed
};

}  // namespace zerodrift::controller
