#pragma once
// Figures of a positioning test: ISO 230-2:2014 clauses 4 and 8 (accuracy, repeatability, reversal) and VDI/DGQ 3441.
// Deviations in um; standard deviations with n - 1. Figures that the data cannot give (one direction, one run) are NaN.

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/compensation/laser.h"

namespace zerodrift::compensation {

struct TargetFigures {
  double target_mm = 0.0;
  int runs_up = 0;
  int runs_down = 0;
  double mean_up_um = 0.0;
  double mean_down_um = 0.0;
  double s_up_um = 0.0;
  double s_down_um = 0.0;
  double reversal_um = 0.0;  // B_i = mean up - mean down
};

struct PositioningFigures {
  std::vector<TargetFigures> targets;
  // ISO 230-2
  double A_um, A_up_um, A_down_um;  // accuracy of positioning
  double E_um, E_up_um, E_down_um;  // systematic deviation
  double R_um, R_up_um, R_down_um;  // repeatability
  double B_um, B_mean_um;           // reversal
  double M_um;                      // mean bidirectional deviation
  // VDI/DGQ 3441
  double P_um, Pa_um, Ps_max_um, Ps_mean_um, U_max_um, U_mean_um;
};

PositioningFigures positioning_figures(const LaserReport& report);
nlohmann::json to_json(const PositioningFigures& figures);

}  // namespace zerodrift::compensation
