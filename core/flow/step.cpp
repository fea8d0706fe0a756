#include "core/flow/step.h"

#include <algorithm>

namespace zerodrift::flow {

std::span<const StepInfo> standard_steps() {
  static const std::vector<StepInfo> steps = {
      {"machine", "step.machine.title", {}, {}, "machine", false, true},
      {"calibrate", "step.calibrate.title", {"machine"}, {}, "calibration", false, true},
      {"warmup", "step.warmup.title", {"machine", "calibration"}, {}, "warmup"},
      {"recordings", "step.recordings.title", {"warmup"}, {}, "recordings", true},
      {"sensors", "step.sensors.title", {"warmup"}, {"recordings"}, "sensors", false, false, true},
      {"fit", "step.fit.title", {"warmup", "sensors"}, {"recordings"}, "model", false, false, true},
      {"describe", "step.describe.title", {}, {}, "description", true},
      {"physics", "step.physics.title", {"machine", "warmup"}, {"description", "recordings"}, "physics"},
      {"axis", "step.axis.title", {}, {}, "axis_table", true},
      {"upload", "step.upload.title", {"machine", "model"}, {"axis_table"}, "upload", false, true, true},
      {"verify", "step.verify.title", {"warmup", "calibration", "upload"}, {}, "verification", false, true, true},
      {"report", "step.report.title", {"verification", "warmup"}, {"model", "physics", "axis_table"}, "report"},
  };
  return steps;
}

const StepInfo* find_step(std::string_view id) {
  const auto steps = standard_steps();
  const auto at = std::find_if(steps.begin(), steps.end(), [&](const StepInfo& step) { return step.id == id; });
  return at == steps.end() ? nullptr : &*at;
}

}  // namespace zerodrift::flow
