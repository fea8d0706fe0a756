#include "app/machine/spindle_body.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/machine/nominal.h"

namespace zerodrift::machine {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double stefan_boltzmann_W_m2K4 = 5.670374419e-8;
// Ring borders in m: bore, shaft in three, then the cartridge in two beyond the air gap.
constexpr std::array<double, 4> shaft_radius_m{0.010, 0.0183, 0.0267, 0.035};
constexpr std::array<double, 3> housing_radius_m{0.0352, 0.058, 0.080};
constexpr double bright_metal_emissivity = 0.08;
constexpr double bright_metal_film_W_m2K = 0.45;  // what that emissivity is worth near room temperature
constexpr double rear_contact_W_K = 22.0;
constexpr double front_contact_W_K = 38.0;
constexpr double shaft_share_of_friction = 0.25;  // inner ring; the outer ring sits in the bigger body
constexpr double shaft_share_of_motor = 0.4;
constexpr double stator_loss_W_at_top = 600.0;
constexpr double stator_leak_W_K = 0.1;
constexpr double seat_W_K = 0.2;  // cartridge to headstock, rear third
constexpr double seat_mm = 140.0;

double ring_area(int ring) {
  const double inner = ring < 3 ? shaft_radius_m[ring] : housing_radius_m[ring - 3];
  const double outer = ring < 3 ? shaft_radius_m[ring + 1] : housing_radius_m[ring - 2];
  return pi * (outer * outer - inner * inner);
}

double ring_middle(int ring) {
  return ring < 3 ? (shaft_radius_m[ring] + shaft_radius_m[ring + 1]) / 2
                  : (housing_radius_m[ring - 3] + housing_radius_m[ring - 2]) / 2;
}

/// Conductance of a cylinder wall between two radii over a length.
double radial_W_K(double inner_m, double outer_m, double conductivity, double length_m) {
  return conductivity * 2.0 * pi * length_m / std::log(outer_m / inner_m);
}

double relative_speed(double speed_rpm) {
  return std::max(0.0, speed_rpm) / nominal::top_speed_rpm;
}

/// Palmgren's friction moment as the contract writes it, in N mm; viscosity in mm2/s, speed in rpm.
double friction_Nmm(const nominal::Bearing& bearing, double speed_rpm, double viscosity_factor, double load_factor) {
  const double dm = bearing.mean_diameter_mm;
  const double oil = bearing.viscosity_mm2_s * viscosity_factor * speed_rpm;
  const double lubrication = oil >= 2000.0 ? 1e-7 * std::pow(oil, 2.0 / 3.0) : 160e-7;
  return bearing.f0 * lubrication * dm * dm * dm + bearing.f1 * bearing.load_N * load_factor * dm;
}

}  // namespace

double SpindleBody::length_m(int cell) const {
  return (m_face_mm[cell + 1] - m_face_mm[cell]) / 1000.0;
}

double SpindleBody::middle_mm(int cell) const {
  return (m_face_mm[cell] + m_face_mm[cell + 1]) / 2.0;
}

SpindleBody::CellShare SpindleBody::share_of(double from_mm, double to_mm) const {
  CellShare share{};
  for (int i = 0; i < cells; ++i) {
    const double low = std::max(from_mm, m_face_mm[i]);
    const double high = std::min(to_mm, m_face_mm[i + 1]);
    share[i] = std::max(0.0, high - low) / (to_mm - from_mm);
  }
  return share;
}

/// Equal cells; a joint is a plane, so the face next to it moves there.
void SpindleBody::place_faces() {
  constexpr double cell_mm = nominal::spindle_length_mm / cells;
  for (int face = 0; face <= cells; ++face) m_face_mm[face] = face * cell_mm;
  const HiddenEffect* joint = m_parameters.hidden.find("contact_resistance");
  if (joint == nullptr) return;
  m_joint_face = std::clamp(static_cast<int>(std::lround(joint->position_mm / cell_mm)), 1, cells - 1);
  m_face_mm[m_joint_face] = joint->position_mm;
}

SpindleBody::SpindleBody(ThermalNetwork& network, const MachineParameters& parameters, int room, int jacket,
                         int headstock)
    : m_parameters(parameters) {
  place_faces();
  build_rings(network);
  build_gap_and_films(network, room, headstock);
  build_stator(network, jacket, headstock);
}

void SpindleBody::build_rings(ThermalNetwork& network) {
  const double volumetric = nominal::density_kg_m3 * nominal::heat_capacity_J_kgK * m_parameters.capacity;
  const double conductivity = nominal::conductivity_W_mK * m_parameters.conductivity;
  for (int ring = 0; ring < rings; ++ring) m_ring_area_m2[ring] = ring_area(ring);
  for (int cell = 0; cell < cells; ++cell) {
    for (int ring = 0; ring < rings; ++ring) {
      m_nodes.push_back(network.add_node(volumetric * m_ring_area_m2[ring] * length_m(cell)));
    }
    for (int ring = 0; ring + 1 < rings; ++ring) {
      if (ring == shaft_rings - 1) continue;  // the air gap, below
      network.add_link(node(cell, ring), node(cell, ring + 1),
                       radial_W_K(ring_middle(ring), ring_middle(ring + 1), conductivity, length_m(cell)));
    }
  }
  const HiddenEffect* joint = m_parameters.hidden.find("contact_resistance");
  for (int cell = 0; cell + 1 < cells; ++cell) {
    const double between_m = (middle_mm(cell + 1) - middle_mm(cell)) / 1000.0;
    const double joint_m2K_W = cell + 1 == m_joint_face ? joint->size : 0.0;
    for (int ring = 0; ring < rings; ++ring) {
      network.add_link(node(cell, ring), node(cell + 1, ring),
                       m_ring_area_m2[ring] / (between_m / conductivity + joint_m2K_W));
    }
  }
}

void SpindleBody::build_gap_and_films(ThermalNetwork& network, int room, int headstock) {
  const auto contact = [&](Bearing& bearing, double from_mm, double to_mm, double total_W_K) {
    bearing.share = share_of(from_mm, to_mm);
    bearing.contact_W_K = total_W_K * m_parameters.contact;
    for (int cell = 0; cell < cells; ++cell) {
      bearing.link[cell] =
          bearing.share[cell] > 0 ? network.add_link(node(cell, shaft_rings - 1), node(cell, shaft_rings), 0.0) : -1;
    }
  };
  const CellShare seat = share_of(0.0, seat_mm);
  for (int cell = 0; cell < cells; ++cell) {
    m_gap[cell] = network.add_link(node(cell, shaft_rings - 1), node(cell, shaft_rings), 0.0);
    m_film[cell] = network.add_boundary_link(node(cell, rings - 1), room, 0.0);
    if (seat[cell] > 0.0) network.add_link(node(cell, rings - 1), headstock, seat_W_K * seat[cell]);
  }
  m_nose_film = network.add_boundary_link(node(cells - 1, shaft_rings - 1), room, 0.0);
  contact(m_front, nominal::front_bearing.from_mm, nominal::front_bearing.to_mm, front_contact_W_K);
  contact(m_rear, nominal::rear_bearing.from_mm, nominal::rear_bearing.to_mm, rear_contact_W_K);
}

void SpindleBody::build_stator(ThermalNetwork& network, int jacket, int headstock) {
  m_motor = share_of(nominal::motor_from_mm, nominal::motor_to_mm);
  for (int cell = 0; cell < cells; ++cell) {
    if (m_motor[cell] <= 0) continue;
    const int stator = network.add_node(3200.0 * m_motor[cell]);
    network.add_boundary_link(stator, jacket, 60.0 * m_motor[cell]);
    network.add_link(stator, node(cell, shaft_rings), stator_leak_W_K * m_motor[cell]);
    network.add_link(stator, headstock, 1.2 * m_motor[cell]);
    m_stator.push_back(stator);
  }
}

void SpindleBody::prepare(ThermalNetwork& network, const SpindleInputs& inputs, double room_C, double time_s) {
  if (inputs.speed_rpm > 1.0) m_turning_s += time_s - m_last_time_s;
  m_last_time_s = time_s;
  m_idle_load_W = 0.0;
  prepare_films(network, inputs, room_C, time_s);
  prepare_bearing(network, m_front, inputs, true);
  prepare_bearing(network, m_rear, inputs, false);
  const double relative = relative_speed(inputs.speed_rpm);
  const double rotor_W =
      nominal::motor_rated_power_W * (1.0 - nominal::motor_net_efficiency) * relative * m_parameters.motor_heat;
  const double stator_W = stator_loss_W_at_top * relative * m_parameters.motor_heat;
  for (int cell = 0; cell < cells; ++cell) {
    network.add_heat(node(cell, 1), shaft_share_of_motor * rotor_W * m_motor[cell]);
    network.add_heat(node(cell, shaft_rings), (1.0 - shaft_share_of_motor) * rotor_W * m_motor[cell]);
  }
  for (const int stator : m_stator) network.add_heat(stator, stator_W / static_cast<double>(m_stator.size()));
  m_idle_load_W += rotor_W + stator_W;
  prepare_hidden_heat(network, inputs, time_s);
}

void SpindleBody::prepare_bearing(ThermalNetwork& network, Bearing& bearing, const SpindleInputs& inputs, bool front) {
  const HiddenEffects& hidden = m_parameters.hidden;
  double bearing_C = 0.0;
  for (int cell = 0; cell < cells; ++cell) {
    const double middle =
        (network.temperature_C(node(cell, shaft_rings - 1)) + network.temperature_C(node(cell, shaft_rings))) / 2;
    bearing_C += bearing.share[cell] * middle;
  }
  const double rise_K = bearing_C - m_parameters.room_start_C;
  const double viscosity = std::exp(-hidden.size_if("bearing_viscosity") * rise_K);
  const double load = std::max(0.2, 1.0 + hidden.size_if("bearing_preload") * rise_K);
  const HiddenEffect* fresh = hidden.find("bearing_run_in");
  const double run_in = fresh != nullptr ? 1.0 + fresh->size * std::exp(-m_turning_s / fresh->time_constant_s) : 1.0;
  const nominal::Bearing& drawing = front ? nominal::front_bearing : nominal::rear_bearing;
  const double scale = (front ? m_parameters.front_heat : m_parameters.rear_heat) * run_in;
  const double heat_W = 1.047e-4 * inputs.speed_rpm * scale * friction_Nmm(drawing, inputs.speed_rpm, viscosity, load);
  m_idle_load_W += heat_W;
  // balls carry more heat across when they roll: contact area and oil film
  const double contact = bearing.contact_W_K * (1.0 + 0.6 * relative_speed(inputs.speed_rpm));
  for (int cell = 0; cell < cells; ++cell) {
    if (bearing.link[cell] < 0) continue;
    network.set_link(bearing.link[cell], contact * bearing.share[cell]);
    network.add_heat(node(cell, shaft_rings - 1), shaft_share_of_friction * heat_W * bearing.share[cell]);
    network.add_heat(node(cell, shaft_rings), (1.0 - shaft_share_of_friction) * heat_W * bearing.share[cell]);
  }
}

void SpindleBody::prepare_films(ThermalNetwork& network, const SpindleInputs& inputs, double room_C, double time_s) {
  const HiddenEffects& hidden = m_parameters.hidden;
  const double relative = relative_speed(inputs.speed_rpm);
  const HiddenEffect* draught = hidden.find("draught");
  const double emissivity = hidden.is("radiation") ? hidden.size_if("radiation") : bright_metal_emissivity;
  double film = nominal::film_W_m2K * m_parameters.film - bright_metal_film_W_m2K;
  if (hidden.is("convection")) film = hidden.size_if("convection");
  film += hidden.size_if("speed_convection") * std::pow(relative, 0.7);
  if (draught != nullptr && time_s >= draught->from_s) film += draught->size;
  // air gap: conduction through 0.2 mm of air, more as the flow in it turns over
  const double gap_film = 0.027 / 0.0002 * (1.0 + 1.2 * std::sqrt(relative));
  const double conductivity = nominal::conductivity_W_mK * m_parameters.conductivity;
  const double room_K = room_C + 273.15;
  constexpr double front_mm = nominal::spindle_length_mm / 2.0;
  for (int cell = 0; cell < cells; ++cell) {
    const double cell_m = length_m(cell);
    const double walls_K_W = 1.0 / radial_W_K(ring_middle(2), shaft_radius_m[3], conductivity, cell_m) +
                             1.0 / radial_W_K(housing_radius_m[0], ring_middle(3), conductivity, cell_m);
    const double gap_K_W = 1.0 / (gap_film * 2.0 * pi * shaft_radius_m[3] * cell_m);
    const double outside_m2 = 2.0 * pi * housing_radius_m[2] * cell_m;
    network.set_link(m_gap[cell], 1.0 / (walls_K_W + gap_K_W));
    const double surface_K = network.temperature_C(node(cell, rings - 1)) + 273.15;
    const double radiation =
        emissivity * stefan_boltzmann_W_m2K4 * (surface_K + room_K) * (surface_K * surface_K + room_K * room_K);
    double washed = 0.0;  // coolant at the room's temperature, on the front half
    if (inputs.coolant_on) {
      const double front_share = std::clamp((m_face_mm[cell + 1] - front_mm) / (1000.0 * cell_m), 0.0, 1.0);
      washed = front_share * hidden.size_if("coolant");
    }
    network.set_boundary_link(m_film[cell], (film + radiation + washed) * outside_m2);
  }
  const double nose_m2 = pi * (shaft_radius_m[3] * shaft_radius_m[3] - shaft_radius_m[0] * shaft_radius_m[0]);
  network.set_boundary_link(m_nose_film, (8.0 + 15.0 * std::pow(relative, 0.7)) * nose_m2);
}

/// Between the middles of which two cells a place lies, and how much of the way it is.
SpindleBody::Between SpindleBody::between(double position_mm) const {
  int low = 0;
  while (low + 2 < cells && middle_mm(low + 1) <= position_mm) ++low;
  const double part = (position_mm - middle_mm(low)) / (middle_mm(low + 1) - middle_mm(low));
  return {low, std::clamp(part, 0.0, 1.0)};
}

void SpindleBody::add_hidden_heat(ThermalNetwork& network, double position_mm, double heat_W) {
  // Over the two nearest cells, so that its centre of gravity is where the answer says.
  const auto [low, part] = between(position_mm);
  for (const auto& [cell, share] : {std::pair{low, 1.0 - part}, std::pair{low + 1, part}}) {
    network.add_heat(node(cell, shaft_rings), 0.75 * heat_W * share);
    network.add_heat(node(cell, shaft_rings - 1), 0.25 * heat_W * share);
  }
}

void SpindleBody::prepare_hidden_heat(ThermalNetwork& network, const SpindleInputs& inputs, double time_s) {
  const HiddenEffects& hidden = m_parameters.hidden;
  if (const HiddenEffect* cutting = hidden.find("cutting_heat")) {
    const double heat_W = cutting->size * inputs.load_W;
    for (int ring = 0; ring < shaft_rings; ++ring) network.add_heat(node(cells - 1, ring), heat_W / shaft_rings);
  }
  if (const HiddenEffect* standing = hidden.find("standing_heat")) {
    add_hidden_heat(network, standing->position_mm, standing->size);
  }
  const HiddenEffect* extra = hidden.find("extra_heat_source");
  if (extra != nullptr && inputs.speed_rpm > 1.0) {
    const double against_3000 = inputs.speed_rpm / 3000.0;
    const double law = extra->law == "n" ? against_3000 : extra->law == "n2" ? against_3000 * against_3000 : 1.0;
    add_hidden_heat(network, extra->position_mm, extra->size * law);
    m_idle_load_W += extra->size * law;
  }
  if (const HiddenEffect* wandering = hidden.find("unlisted:wandering_heat")) {
    const double phase = static_cast<double>(m_parameters.seed % 7);
    const double level = std::sin(time_s / 2700.0 + 1.3 * std::sin(time_s / 1130.0 + phase));
    add_hidden_heat(network, wandering->position_mm, wandering->size * std::max(0.0, level));
  }
}

double SpindleBody::housing_C(const ThermalNetwork& network, double position_mm) const {
  // the sensors' holes end in the middle of the wall
  const auto wall_C = [&](int cell) {
    return (network.temperature_C(node(cell, shaft_rings)) + network.temperature_C(node(cell, shaft_rings + 1))) / 2;
  };
  auto [low, part] = between(position_mm);
  // A sensor beside a joint reads its own side, as far from the next cell's middle as it is.
  if (low + 1 == m_joint_face) {
    const bool behind = position_mm < m_face_mm[m_joint_face];
    low = behind ? std::max(0, low - 1) : std::min(low + 1, cells - 2);
    part = (position_mm - middle_mm(low)) / (middle_mm(low + 1) - middle_mm(low));
  }
  return (1.0 - part) * wall_C(low) + part * wall_C(low + 1);
}

double SpindleBody::stator_C(const ThermalNetwork& network) const {
  double sum = 0.0;
  for (const int stator : m_stator) sum += network.temperature_C(stator);
  return sum / static_cast<double>(m_stator.size());
}

double SpindleBody::growth_um(const ThermalNetwork& network) const {
  double rise_K_m = 0.0;
  double area = 0.0;
  for (int ring = 0; ring < shaft_rings; ++ring) area += m_ring_area_m2[ring];
  for (int cell = 0; cell < cells; ++cell) {
    for (int ring = 0; ring < shaft_rings; ++ring) {
      const double rise_K = network.temperature_C(node(cell, ring)) - m_parameters.room_start_C;
      rise_K_m += rise_K * m_ring_area_m2[ring] / area * length_m(cell);
    }
  }
  return nominal::expansion_1_K * m_parameters.expansion * rise_K_m * 1e6;
}

}  // namespace zerodrift::machine
