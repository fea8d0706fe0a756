#pragma once
// The truth of everything but the spindle: headstock, column, bed, ball screws with nuts, guides and support bearings,
// trunnion and table with their drives, coolant tank.

#include <array>
#include <string_view>
#include <vector>

#include "app/machine/parameters.h"
#include "app/machine/thermal_network.h"

namespace zerodrift::machine {

struct StructureInputs {
  std::array<double, 3> feed_mm_min{};  // mean absolute feed of X, Y, Z
  bool cycle = false;                   // A and C move with it
  bool coolant_on = false;
};

enum class Part {
  headstock,
  column_front_top,
  column_front_foot,
  column_rear_top,
  column_rear_foot,
  bed_left,
  bed_middle,
  bed_right,
  trunnion,
  drive_A,
  drive_C,
  table,
  tank,
};
inline constexpr int part_count = 13;

class StructureBody {
 public:
  StructureBody(ThermalNetwork& network, const MachineParameters& parameters, int room);

  void prepare(ThermalNetwork& network, const StructureInputs& inputs);
  int node(Part part) const { return m_parts[static_cast<int>(part)]; }
  int nut_node(int axis) const { return m_screws[axis].nut; }
  int guide_node(int axis) const { return m_screws[axis].guide; }
  int support_node(int axis) const { return m_screws[axis].support; }
  /// Growth of the screw from its support bearing to the nut at the middle of the travel.
  double screw_growth_um(const ThermalNetwork& network, int axis) const;

 private:
  static constexpr int screw_cells = 5;
  struct Screw {
    std::array<int, screw_cells> cell{};
    std::array<int, screw_cells> film{};
    int nut = 0;
    int guide = 0;
    int support = 0;
  };

  void build_frame(ThermalNetwork& network, int room);
  void build_screw(ThermalNetwork& network, int room, int axis);

  const MachineParameters& m_parameters;
  std::array<int, part_count> m_parts{};
  std::array<Screw, 3> m_screws;
  int m_coolant_table = 0;
  int m_coolant_bed = 0;
};

}  // namespace zerodrift::machine
