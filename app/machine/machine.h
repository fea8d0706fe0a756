#pragma once
// The virtual machine tool without any server: physics, axes, sensors and controller on one clock, moved on by advance.
// Not thread-safe; live_machine.h puts a lock and the wall clock around it.

#include <array>
#include <cstdint>
#include <optional>

#include "app/machine/camera/scene.h"
#include "app/machine/camera/view.h"
#include "app/machine/compensator.h"
#include "app/machine/motion.h"
#include "app/machine/sensors.h"
#include "app/machine/table_store.h"
#include "app/machine/thermal_model.h"

namespace zerodrift::machine {

/// What a sensor can suffer; "sporadic" faults come and go.
struct SensorFault {
  enum class Kind {
    none,
    stuck,  // repeats its last value
    dead,   // broken wire
  };
  Kind kind = Kind::none;
  bool always = false;
  int sensor = 1;
};

class Machine {
 public:
  explicit Machine(const MachineParameters& parameters);

  void advance_to(double time_s);
  double time_s() const { return m_time_s; }

  // commands
  void command_speed(double rpm) { m_commanded_rpm = rpm; }
  void command_coolant(bool on) { m_coolant_on = on; }
  void command_cutting(double cutting_W) { m_cutting_W = cutting_W; }
  void set_sensor_fault(SensorFault fault) { m_sensor_fault = fault; }
  Motion& motion() { return m_motion; }
  Compensator& compensator() { return m_compensator; }
  TableStore& table_store() { return m_table_store; }

  // state
  const Motion& motion() const { return m_motion; }
  const Compensator& compensator() const { return m_compensator; }
  const TableStore& table_store() const { return m_table_store; }
  double speed_rpm() const { return m_speed_rpm; }
  double commanded_rpm() const { return m_commanded_rpm; }
  /// When the spindle turned for the first time: work began.
  std::optional<double> first_turn_s() const { return m_first_turn_s; }
  bool coolant_on() const { return m_coolant_on; }
  double spindle_load_W() const { return m_thermal.spindle_load_W(); }
  /// Last conversion in 1/16 C; 0 the room, 1 to 20 the sensors.
  std::int16_t raw_temperature(int sensor) const { return m_raw[sensor]; }
  const ThermalModel& thermal() const { return m_thermal; }

  // truth
  /// Actual - commanded at the nose, with everything in it.
  Axes true_error_um() const;
  /// X1 X2 Y1 Y2 Z of the five-probe nest: 1 at the nose, 2 a lever of 100 mm above it.
  std::array<double, 5> probes_um() const;
  bool at_nest() const;
  CameraScene scene(View view) const;

 private:
  void advance_step(double duration_s);
  void advance_thermal();
  void convert_temperatures();
  void advance_cameras();

  const MachineParameters m_parameters;
  ThermalModel m_thermal;
  SensorBoard m_board;
  Motion m_motion;
  Compensator m_compensator;
  TableStore m_table_store;
  SensorFault m_sensor_fault;
  double m_time_s = 0.0;
  double m_commanded_rpm = 0.0;
  double m_speed_rpm = 0.0;
  std::optional<double> m_first_turn_s;
  bool m_coolant_on = false;
  double m_cutting_W = 0.0;
  // means over the running thermal step
  double m_speed_sum = 0.0;
  double m_cycle_sum_s = 0.0;
  Axes m_way_at_step_mm{};
  std::int64_t m_conversions = -1;
  std::array<std::int16_t, sensor_count + 1> m_raw{};
  TableTemperatures m_filtered_C{};
  double m_bracket_K = 0.0;  // temperature of the cameras' bracket against the start
  Axes m_bracket_wander_um{};
  Noise m_bracket_noise;
  std::array<double, view_count> m_roll_wander_urad{};
  std::array<double, view_count> m_scale_wander_ppm{};
  Noise m_turn_noise;
};

}  // namespace zerodrift::machine
