#pragma once
// Drives the machine to the proposed positions, looks at the target there, and calibrates (V2). Every position is
// reached from the same side, the coordinates are read back from the controller, and the machine ends at the place of
// the template.

#include <array>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "core/acquisition/drift_limit.h"
#include "core/acquisition/latency.h"
#include "core/acquisition/machine_io.h"
#include "core/base/task_context.h"
#include "core/vision/calibration.h"
#include "core/vision/picture_source.h"
#include "core/vision/target.h"

namespace zerodrift::vision {

struct CalibrationPlan {
  std::array<std::string, 2> axes{"X", "Z"};  // seen to the right and upwards
  std::map<std::string, double> centre_mm;    // machine position of the template, every axis to be held
  double span_mm = 1.6;
  int per_side = 3;
  double approach_mm = 0.1;
  int frames = 4;  // averaged at each position
  std::chrono::milliseconds frame_timeout{4000};
  acquisition::Latency latency;  // of the camera
  acquisition::DriftRule drift;  // what heat can make of where the target is
  double time_factor = 1.0;      // machine seconds in a host second
};

struct CalibrationOutcome {
  Calibration calibration;
  Target target;                  // with the mask learned from the moves
  std::vector<GrayImage> frames;  // one at each position, for the record
};

/// After each position: how many of how many, the frame there and what was seen.
using CalibrationWatcher = std::function<void(int done, int of, const GrayImage& frame, const Location& location)>;

/// What the fixed marks show of the camera's own drift meanwhile is taken off; a frame without them counts as it is. A
/// view that shows the target farther from where the machine was sent than heat can move it is taken anew once, and
/// then refused by its name. `host` is the clock by which the pictures are stamped. Errors: those of the machine and
/// the camera, target_refused, calibration_refused, cancelled.
Result<CalibrationOutcome> run_calibration(acquisition::MachineIo& machine, const PictureSource& camera,
                                           const Target& target, const std::vector<Target>& marks,
                                           const CalibrationPlan& plan, const TaskContext& context,
                                           const CalibrationWatcher& watcher = {}, Clock& host = host_clock());

}  // namespace zerodrift::vision
