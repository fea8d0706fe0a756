#pragma once
// The spindle's truth: shaft and cartridge housing as axial cells by radial rings, joined by the air gap and by the
// bearings' contact; Palmgren friction in the bearings, rotor loss in the shaft, stator behind its cooling jacket.
// x runs from the fixed rear end to the nose.

#include <array>
#include <vector>

#include "app/machine/parameters.h"
#include "app/machine/thermal_network.h"

namespace zerodrift::machine {

struct SpindleInputs {
  double speed_rpm = 0.0;
  bool coolant_on = false;
  double load_W = 0.0;
};

class SpindleBody {
 public:
  /// Adds the nodes; headstock is the node the cartridge sits in.
  SpindleBody(ThermalNetwork& network, const MachineParameters& parameters, int room, int jacket, int headstock);

  /// Conductances and heats of the coming step, from the temperatures now.
  void prepare(ThermalNetwork& network, const SpindleInputs& inputs, double room_C, double time_s);
  /// Temperature of the cartridge's wall, linear between the cells' middles.
  double housing_C(const ThermalNetwork& network, double position_mm) const;
  /// Mean of the stator.
  double stator_C(const ThermalNetwork& network) const;
  /// Growth of the shaft from its fixed end to the nose.
  double growth_um(const ThermalNetwork& network) const;
  /// Friction and iron loss that the drive must feed at this state, W.
  double idle_load_W() const { return m_idle_load_W; }

 private:
  static constexpr int cells = 40;
  static constexpr int shaft_rings = 3;
  static constexpr int housing_rings = 2;
  static constexpr int rings = shaft_rings + housing_rings;
  using CellShare = std::array<double, cells>;  // sums to 1

  struct Between {
    int cell;
    double part;
  };
  struct Bearing {
    CellShare share;
    std::array<int, cells> link{};  // contact, -1 where the bearing is not
    double contact_W_K;
  };

  void place_faces();
  void build_rings(ThermalNetwork& network);
  void build_gap_and_films(ThermalNetwork& network, int room, int headstock);
  void build_stator(ThermalNetwork& network, int jacket, int headstock);
  double length_m(int cell) const;
  double middle_mm(int cell) const;
  CellShare share_of(double from_mm, double to_mm) const;
  Between between(double position_mm) const;
  void prepare_bearing(ThermalNetwork& network, Bearing& bearing, const SpindleInputs& inputs, bool front);
  void prepare_films(ThermalNetwork& network, const SpindleInputs& inputs, double room_C, double time_s);
  void add_hidden_heat(ThermalNetwork& network, double position_mm, double heat_W);
  void prepare_hidden_heat(ThermalNetwork& network, const SpindleInputs& inputs, double time_s);
  int node(int cell, int ring) const { return m_nodes[cell * rings + ring]; }

  const MachineParameters& m_parameters;
  std::array<double, cells + 1> m_face_mm{};
  int m_joint_face = -1;  // of m_face_mm; -1: no joint
  std::vector<int> m_nodes;
  std::array<double, rings> m_ring_area_m2{};
  std::array<int, cells> m_gap{};
  std::array<int, cells> m_film{};
  int m_nose_film = 0;
  Bearing m_front;
  Bearing m_rear;
  CellShare m_motor;
  std::vector<int> m_stator;
  double m_idle_load_W = 0.0;
  double m_turning_s = 0.0;  // running time so far, for the run-in
  double m_last_time_s = 0.0;
};

}  // namespace zerodrift::machine
