#include "core/flow/step.h"

#include <algorithm>

namespace zerodrift::flow {

std::span<const StepInfo> standard_steps() {
  static const std::vector<StepInfo> steps = {
      {"machine", "step.machine.title", {}, {}, "machine", false},
      {"calibrate", "step.calibrate.title", {"machine"}, {}, "calibration", false},
      {"warmup", "step.warmup.title", {"machine", "calibration"}, {}, "warmup", false},
      {"sensors", "step.sensors.title", {"warmup"}, {}, "sensors", false},
      {"fit", "step.fit.title", {"warmup", "sensors"}, {}, "model", false},
      {"physics", "step.physics.title", {"machine", "warmup"}, {}, "physics", false},
      {"axis", "step.axis.title", {}, {}, "axis_table", true},
      {"upload", "step.upload.title", {"machine", "model"}, {"axis_table"}, "upload", false},
      {"verify", "step.verify.title", {"warmup", "calibration", "upload"}, {}, "verification", false},
      {"report", "step.report.title", {"verification"}, {"physics", "axis_table"}, "report", false},
  };
  return steps;
}

const StepInfo* find_step(std::string_view id) {
  const auto steps = standard_steps();
  const auto at = std::find_if(steps.begin(), steps.end(), [&](const StepInfo& step) { return step.id == id; });
  return at == steps.end() ? nullptr : &*at;
}

}  // namespace zerodrift::flow
