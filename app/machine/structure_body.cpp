#include "app/machine/structure_body.h"

#include <cmath>

namespace zerodrift::machine {
namespace {

constexpr double screw_expansion_1_K = 1.15e-5;
constexpr double screw_cell_m = 0.14;     // five of them, 700 mm of screw
constexpr double screw_cell_J_K = 405.0;  // 32 mm diameter
constexpr double screw_axial_W_K = 0.26;  // k A / cell
constexpr double screw_film_W_K = 0.2;    // per cell, standing
constexpr double nut_friction_N = 300.0;
constexpr double guide_friction_N = 160.0;
constexpr int fixed_support_cell = 0;
constexpr int nut_cell = 2;

struct PartData {
  double capacity_J_K;
  double film_W_K;
};
// in the order of Part: cast iron at 500 J/kgK; the tank holds 60 l of water-based coolant
constexpr std::array<PartData, part_count> part_data{{{16000, 3.2},
                                                      {36000, 4.0},
                                                      {42000, 4.0},
                                                      {36000, 4.0},
                                                      {42000, 4.0},
                                                      {130000, 5.0},
                                                      {150000, 5.0},
                                                      {130000, 5.0},
                                                      {24000, 3.0},
                                                      {6000, 1.5},
                                                      {7000, 1.5},
                                                      {22000, 2.5},
                                                      {250000, 12.0}}};

struct PartLink {
  Part a;
  Part b;
  double conductance_W_K;
};
constexpr std::array part_links{
    PartLink{Part::headstock, Part::column_front_top, 3.0},
    PartLink{Part::column_front_top, Part::column_front_foot, 2.2},
    PartLink{Part::column_rear_top, Part::column_rear_foot, 2.2},
    PartLink{Part::column_front_top, Part::column_rear_top, 1.6},
    PartLink{Part::column_front_foot, Part::column_rear_foot, 2.0},
    PartLink{Part::column_front_foot, Part::bed_middle, 4.0},
    PartLink{Part::column_rear_foot, Part::bed_middle, 4.0},
    PartLink{Part::bed_left, Part::bed_middle, 6.0},
    PartLink{Part::bed_middle, Part::bed_right, 6.0},
    PartLink{Part::trunnion, Part::bed_left, 1.5},
    PartLink{Part::trunnion, Part::bed_right, 1.5},
    PartLink{Part::drive_A, Part::trunnion, 3.0},
    PartLink{Part::drive_C, Part::trunnion, 2.0},
    PartLink{Part::drive_C, Part::table, 2.5},
    PartLink{Part::table, Part::trunnion, 2.0},
};

}  // namespace

StructureBody::StructureBody(ThermalNetwork& network, const MachineParameters& parameters, int room)
    : m_parameters(parameters) {
  build_frame(network, room);
  for (int axis = 0; axis < 3; ++axis) build_screw(network, room, axis);
}

void StructureBody::build_frame(ThermalNetwork& network, int room) {
  for (int i = 0; i < part_count; ++i) {
    m_parts[i] = network.add_node(part_data[i].capacity_J_K);
    network.add_boundary_link(m_parts[i], room, part_data[i].film_W_K * m_parameters.structure_film);
  }
  for (const PartLink& link : part_links) network.add_link(node(link.a), node(link.b), link.conductance_W_K);
  m_coolant_table = network.add_link(node(Part::table), node(Part::tank), 0.0);
  m_coolant_bed = network.add_link(node(Part::bed_middle), node(Part::tank), 0.0);
}

void StructureBody::build_screw(ThermalNetwork& network, int room, int axis) {
  Screw& screw = m_screws[axis];
  constexpr std::array<Part, 3> seat{Part::bed_left, Part::bed_right, Part::column_rear_top};
  constexpr std::array<Part, 3> carried{Part::trunnion, Part::column_front_foot, Part::headstock};
  for (int i = 0; i < screw_cells; ++i) {
    screw.cell[i] = network.add_node(screw_cell_J_K);
    screw.film[i] = network.add_boundary_link(screw.cell[i], room, screw_film_W_K);
    if (i > 0) network.add_link(screw.cell[i - 1], screw.cell[i], screw_axial_W_K);
  }
  screw.nut = network.add_node(1300.0);
  screw.guide = network.add_node(5000.0);
  screw.support = network.add_node(4500.0);
  // the nut travels over the middle three cells
  for (int i = 1; i <= 3; ++i) network.add_link(screw.nut, screw.cell[i], 0.9);
  network.add_link(screw.nut, node(carried[axis]), 0.8);
  network.add_link(screw.guide, node(carried[axis]), 1.2);
  network.add_link(screw.guide, node(seat[axis]), 1.2);
  network.add_link(screw.support, screw.cell[fixed_support_cell], 0.7);
  network.add_link(screw.support, node(seat[axis]), 2.0);
  network.add_boundary_link(screw.support, room, 1.0);
  network.add_boundary_link(screw.guide, room, 0.5);
}

void StructureBody::prepare(ThermalNetwork& network, const StructureInputs& inputs) {
  const double friction = m_parameters.screw_friction;
  for (int axis = 0; axis < 3; ++axis) {
    const Screw& screw = m_screws[axis];
    const double feed_m_s = std::abs(inputs.feed_mm_min[axis]) / 60000.0;
    const double nut_W = nut_friction_N * friction * feed_m_s;
    network.add_heat(screw.nut, 0.5 * nut_W);
    for (int i = 1; i <= 3; ++i) network.add_heat(screw.cell[i], 0.5 * nut_W / 3.0);
    network.add_heat(screw.guide, guide_friction_N * friction * feed_m_s);
    // servo motor and fixed bearing; the Z motor also holds the head's weight
    const double standing_W = axis == 2 ? 9.0 : 1.5;
    network.add_heat(screw.support, (standing_W + 140.0 * feed_m_s) * m_parameters.drive_heat);
    for (const int film : screw.film) network.set_boundary_link(film, screw_film_W_K * (1.0 + 6.0 * feed_m_s));
  }
  if (inputs.cycle) {
    network.add_heat(node(Part::drive_A), 22.0 * m_parameters.drive_heat);
    network.add_heat(node(Part::drive_C), 26.0 * m_parameters.drive_heat);
  }
  network.set_link(m_coolant_table, inputs.coolant_on ? 14.0 : 0.0);
  network.set_link(m_coolant_bed, inputs.coolant_on ? 9.0 : 0.0);
  if (inputs.coolant_on) network.add_heat(node(Part::tank), 110.0);  // the pump's power ends up in the coolant
}

double StructureBody::screw_growth_um(const ThermalNetwork& network, int axis) const {
  double rise_K_m = 0.0;
  for (int i = fixed_support_cell; i <= nut_cell; ++i) {
    const double length_m = i == nut_cell ? screw_cell_m / 2 : screw_cell_m;
    rise_K_m += (network.temperature_C(m_screws[axis].cell[i]) - m_parameters.room_start_C) * length_m;
  }
  return screw_expansion_1_K * rise_K_m * 1e6;
}

}  // namespace zerodrift::machine
