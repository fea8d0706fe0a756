#pragma once
// What the job needs of a machine tool, whatever carries it: a controller over Modbus, a test double.
// One object is used from one thread at a time. Every call has a timeout of its own and a named failure.

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace zerodrift::acquisition {

struct SensorInfo {
  std::string channel;  // "T1_C"
  std::string label;    // "Spindle front bearing"
  std::string place;    // component id, for the drawing
  double accuracy_C = 0.1;
};

/// What is known of the connected machine; from the identity registers and the profile.
struct MachineIdentity {
  std::string name;
  std::uint32_t serial = 0;
  int map_version = 0;
  bool accepts_table = false;        // temperature and position terms computed by the controller itself
  bool accepts_host_offset = false;  // an offset written by the host compensator
  bool has_probes = false;
  int table_capacity_registers = 0;
  std::vector<SensorInfo> sensors;
};

/// One coherent reading. NaN where a value is missing or its sensor is dead.
struct MachineSample {
  double machine_time_s = 0.0;         // the controller's own clock
  std::map<std::string, double> axes;  // "X" -> mm, "A" -> degrees
  double spindle_rpm = 0.0;
  double spindle_load_W = 0.0;
  std::map<std::string, double> feed_mm_min;  // "X" -> ...
  bool coolant_on = false;
  bool compensation_on = false;  // the switch of the interlock (R4)
  bool moving = false;
  bool cycling = false;  // on the warm-up path
  bool referenced = true;
  bool alarm = false;
  double ambient_C = 0.0;
  std::vector<double> temperature_C;               // in the order of MachineIdentity::sensors
  std::vector<Seconds> temperature_at{};           // host time of each, where they are not of one request; else empty
  std::array<double, 3> applied_um{};              // compensation the controller applies now, X Y Z
  std::optional<std::array<double, 5>> probes_um;  // displacement probes X1 X2 Y1 Y2 Z, if there are any
  Seconds probes_at{0.0};                          // host time of these
  std::map<std::string, Error> device_faults{};    // device of the rig -> why its values are missing
};

class MachineIo {
 public:
  virtual ~MachineIo() = default;
  virtual Result<MachineIdentity> identify() = 0;
  virtual Result<MachineSample> read() = 0;
  /// Spindle speed, coolant and path motion of a plan step; reached when the machine reports it.
  virtual Status command(double spindle_rpm, bool coolant_on, bool path_cycle) = 0;
  /// Moves the linear axes named and returns when the machine stands there, or fails with a timeout.
  virtual Status move_to(const std::map<std::string, double>& target_mm) = 0;
  virtual Status switch_compensation(bool on) = 0;
  virtual Result<bool> compensation_on() {
    return read().map([](const MachineSample& sample) { return sample.compensation_on; });
  }
  /// Waits until the ramp of the applied compensation has ended and what is applied has come to rest; the percentage
  /// reached (100 when it does not tell).
  virtual Result<double> wait_for_ramp(bool on, const std::stop_token& /*stop*/) { return on ? 100.0 : 0.0; }
  /// A person does what is asked: each act costs their time, and the moment of it is known to that only.
  virtual bool by_hand() const { return false; }
  /// What was met on the way to the machine and overcome, in words; each once.
  virtual std::vector<std::string> remarks() const { return {}; }
  /// Compensation (= -error) in um added by the host, X Y Z; needs the switch on; the machine's watchdog ramps it to 0.
  virtual Status write_host_offset(const std::array<double, 3>& compensation_um) = 0;
};

}  // namespace zerodrift::acquisition
