#pragma once
// Where on a rod a sensor belongs: bisection for the region whose temperature follows the displacement best (the
// published spindle study). Correlation alone is flat along the rod (above 0.99 everywhere in a long warm-up), so the
// regression residual and the lag between temperature and displacement decide with it.

#include <string>
#include <vector>

#include "core/base/task_context.h"
#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::physics {

struct PlaceScore {
  double position_mm = 0.0;
  double correlation = 0.0;  // of temperature and displacement
  double residual_um = 0.0;  // rms of displacement after a straight line in the temperature
  double lag_s = 0.0;        // displacement after temperature: the shift with the smallest residual
  double um_per_K = 0.0;     // slope of that line
};

struct BisectionStep {
  double from_mm = 0.0;
  double to_mm = 0.0;
  PlaceScore left;  // mean temperature of the left half
  PlaceScore right;
  bool took_left = false;
};

struct Placement {
  std::string component;
  std::string error;
  double length_mm = 0.0;
  double from_mm = 0.0;  // the recommended region
  double to_mm = 0.0;
  PlaceScore best;  // at the middle of the region
  std::vector<BisectionStep> steps;
  std::vector<PlaceScore> along;    // along the rod, for drawing
  std::vector<PlaceScore> sensors;  // at the sensors that are there
  std::vector<std::string> sensor_channels;
  bool measured = false;  // the displacement came from the recording, not from the simulation
  std::vector<std::string> notes;
};

struct PlacementOptions {
  std::string error = "dZ_um";
  double smallest_region_mm = 0.0;  // 0: 12.5 mm as in the published case, an eighth of a short rod
};

Result<Placement> place_sensor(const Machine& machine, const recording::Recording& inputs,
                               const PlacementOptions& options = {}, const TaskContext& context = {});

}  // namespace zerodrift::physics
