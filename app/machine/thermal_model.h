#pragma once
// The whole machine's heat and what it does to the nose. Errors = actual - commanded; positive Z is away from the
// spindle's fixed end, towards the work.

#include <array>

#include "app/machine/parameters.h"
#include "app/machine/room.h"
#include "app/machine/spindle_body.h"
#include "app/machine/structure_body.h"
#include "app/machine/thermal_network.h"

namespace zerodrift::machine {

struct MachineInputs {
  double speed_rpm = 0.0;
  bool coolant_on = false;
  double cutting_W = 0.0;  // beyond what the spindle needs to turn idly
  std::array<double, 3> feed_mm_min{};
  bool cycle = false;
};

struct NoseErrors {
  std::array<double, 3> um{};    // X Y Z at the nose
  std::array<double, 2> urad{};  // turning about X, about Y
};

class ThermalModel {
 public:
  static constexpr double step_s = 2.0;

  explicit ThermalModel(const MachineParameters& parameters);
  ThermalModel(const ThermalModel&) = delete;
  ThermalModel& operator=(const ThermalModel&) = delete;

  /// One step of step_s.
  void step(const MachineInputs& inputs);
  double time_s() const { return m_time_s; }
  double room_C() const { return m_room.temperature_C(); }
  double spindle_load_W() const { return m_load_W; }
  /// True temperatures where the sensors sit.
  const std::array<double, sensor_count>& sensor_C() const { return m_sensor_C; }
  const NoseErrors& errors() const { return m_errors; }
  /// The part of Z that the spindle's own growth makes, and the nose against the headstock: what a nest there sees.
  double spindle_growth_um() const { return m_growth_um; }
  std::array<double, 2> nose_against_head_um() const { return m_against_head_um; }
  const ThermalNetwork& network() const { return m_network; }

 private:
  void evaluate();
  void evaluate_hidden();
  double rise_K(Part part) const;

  const MachineParameters m_parameters;
  ThermalNetwork m_network;
  Room m_room;
  int m_room_boundary;
  int m_jacket_boundary;
  StructureBody m_structure;
  SpindleBody m_spindle;
  double m_time_s = 0.0;
  double m_jacket_C;
  double m_load_W = 0.0;
  double m_growth_um = 0.0;
  double m_room_lag_K = 0.0;  // drivers of the structure effects after their first-order lag
  double m_bending_lag_K = 0.0;
  double m_sensor_lag_C;
  std::array<double, sensor_count> m_sensor_C{};
  std::array<double, 2> m_against_head_um{};  // Y, Z
  NoseErrors m_errors;
};

}  // namespace zerodrift::machine
