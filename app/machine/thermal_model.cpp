#include "app/machine/thermal_model.h"

#include <cmath>

#include "app/machine/sensors.h"

namespace zerodrift::machine {
namespace {

constexpr double iron_1_K = 1.1e-5;
constexpr double jacket_memory_s = 2400.0;  // the chiller follows the room

}  // namespace

ThermalModel::ThermalModel(const MachineParameters& parameters)
    : m_parameters(parameters),
      m_room(m_parameters),
      m_room_boundary(m_network.add_boundary(m_parameters.room_start_C)),
      m_jacket_boundary(m_network.add_boundary(m_parameters.room_start_C)),
      m_structure(m_network, m_parameters, m_room_boundary),
      m_spindle(m_network, m_parameters, m_room_boundary, m_jacket_boundary, m_structure.node(Part::headstock)),
      m_jacket_C(m_parameters.room_start_C),
      m_sensor_lag_C(m_parameters.room_start_C) {
  m_network.start(m_parameters.room_start_C);
  evaluate();
}

void ThermalModel::step(const MachineInputs& inputs) {
  const double room_C = m_room.advance(step_s);
  m_jacket_C += (room_C - m_jacket_C) * (1.0 - std::exp(-step_s / jacket_memory_s));
  m_network.set_boundary(m_room_boundary, room_C);
  m_network.set_boundary(m_jacket_boundary, m_jacket_C);
  m_spindle.prepare(m_network, {inputs.speed_rpm, inputs.coolant_on, m_load_W}, room_C, m_time_s);
  m_load_W = m_spindle.idle_load_W() + inputs.cutting_W;
  m_structure.prepare(m_network, {inputs.feed_mm_min, inputs.cycle, inputs.coolant_on});
  m_network.step(step_s);
  m_time_s += step_s;
  evaluate();
}

double ThermalModel::rise_K(Part part) const {
  return m_network.temperature_C(m_structure.node(part)) - m_parameters.room_start_C;
}

void ThermalModel::evaluate() {
  for (int i = 0; i < sensor_count; ++i) {
    m_sensor_C[i] = place_temperature_C(sensor_places()[i], m_network, m_spindle, m_structure);
  }
  const auto um = [](double length_m, double rise) { return iron_1_K * length_m * rise * 1e6; };
  const double front = (rise_K(Part::column_front_top) + rise_K(Part::column_front_foot)) / 2;
  const double rear = (rise_K(Part::column_rear_top) + rise_K(Part::column_rear_foot)) / 2;
  const double head = rise_K(Part::headstock);
  const double bed = (rise_K(Part::bed_left) + rise_K(Part::bed_middle) + rise_K(Part::bed_right)) / 3;
  const MachineParameters& p = m_parameters;
  m_growth_um = m_spindle.growth_um(m_network);
  // column 0.8 m high and 0.45 m deep: a warmer front leans the head backwards
  const double lean_urad = iron_1_K * 0.8 / 0.45 * (front - rear) * 1e6 * p.bending_share;
  const double stator = m_spindle.stator_C(m_network) - p.room_start_C;
  m_errors.urad = {lean_urad + 7.0 * (head - front) * p.bending_share,
                   (4.0 * (rise_K(Part::bed_right) - rise_K(Part::bed_left)) + 2.2 * (stator - head)) * p.side_share};
  const double table = (rise_K(Part::table) + rise_K(Part::trunnion)) / 2;
  m_errors.um = {0.5 * m_structure.screw_growth_um(m_network, 0) * p.screw_share +
                     um(0.16, rise_K(Part::drive_A) - bed) * p.side_share - 0.3 * m_errors.urad[1],
                 -m_structure.screw_growth_um(m_network, 1) * p.screw_share + 0.33 * m_errors.urad[0] +
                     um(0.12, head) * p.head_share,
                 m_growth_um - um(0.24, head) * p.head_share + um(0.20, front) * p.column_share - um(0.20, bed) -
                     um(0.12, table) * p.table_share -
                     0.25 * m_structure.screw_growth_um(m_network, 2) * p.screw_share};
  m_against_head_um = {0.0, m_growth_um};
  evaluate_hidden();
}

void ThermalModel::evaluate_hidden() {
  const HiddenEffects& hidden = m_parameters.hidden;
  double y_um = 0.0;
  double z_um = 0.0;
  const auto follow = [](double& state, double driver, double time_constant_s) {
    state += (driver - state) * (1.0 - std::exp(-step_s / time_constant_s));
    return state;
  };
  if (const HiddenEffect* effect = hidden.find("structure_ambient")) {
    const double driver = m_room.temperature_C() - m_parameters.room_start_C;
    z_um += effect->size * follow(m_room_lag_K, driver, effect->time_constant_s);
  }
  if (const HiddenEffect* effect = hidden.find("structure_bending")) {
    const double driver = m_spindle.housing_C(m_network, 340) - m_spindle.housing_C(m_network, 30);
    y_um += effect->size * follow(m_bending_lag_K, driver, effect->time_constant_s);
  }
  const HiddenEffect* slip = hidden.find("bracket_slip");
  if (slip != nullptr && m_time_s >= slip->from_s) z_um += slip->size;
  if (const HiddenEffect* slack = hidden.find("unlisted:slack")) {
    const auto side = [&](double growth_um) { return std::tanh((growth_um - slack->from_um) / 3.0); };
    z_um += 0.5 * slack->size * (side(m_growth_um) - side(0.0));
  }
  z_um += hidden.size_if("unlisted:creep") * std::log1p(m_time_s / 900.0);
  if (const HiddenEffect* lag = hidden.find("sensor_lag")) {
    double& sensor = m_sensor_C[lag->sensor - 1];
    sensor = follow(m_sensor_lag_C, sensor, lag->size);
  }
  m_errors.um[1] += y_um;
  m_errors.um[2] += z_um;
  m_against_head_um[0] += y_um;
  m_against_head_um[1] += z_um;
}

}  // namespace zerodrift::machine
