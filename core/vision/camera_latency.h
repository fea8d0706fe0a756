#pragma once
// Measures how old a camera's pictures are: the machine moves to and fro between two places that look different, and
// each move shows in the pictures later by the latency.

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/acquisition/latency.h"
#include "core/acquisition/machine_io.h"
#include "core/acquisition/stand.h"
#include "core/base/task_context.h"
#include "core/vision/picture_source.h"

namespace zerodrift::vision {

struct LatencyCamera {
  std::string id;
  const PictureSource* camera = nullptr;
  Region region;  // in which the moves show
};

struct LatencyPlan {
  std::map<std::string, double> centre_mm;  // begins and ends here
  std::vector<std::string> axes;            // that move, together
  double way_mm = 0.8;
  int moves = 8;
  double longest_s = acquisition::assumed_latency_s;  // that is expected
  std::optional<acquisition::Stand> home;             // at the centre since then; nothing: it is driven there first
};

/// The latency of each camera, all by the same moves. Errors: those of the machine and the cameras; calibration_refused
/// when a camera's pictures do not come to rest or do not follow the machine; cancelled. `host` is the clock by which
/// the pictures are stamped.
Result<std::vector<acquisition::Latency>> measure_latency(acquisition::MachineIo& machine,
                                                          const std::vector<LatencyCamera>& cameras,
                                                          const LatencyPlan& plan, const TaskContext& context,
                                                          Clock& host = host_clock());

}  // namespace zerodrift::vision
