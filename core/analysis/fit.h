#pragma once
// Regression from the sensitive temperatures (and, for dynamic models, the speeds) to each error.

#include <string>
#include <vector>

#include "core/analysis/model.h"
#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis {

struct FitOptions {
  std::vector<std::string> sensors;  // empty: chosen by the fit
  std::vector<std::string> errors;   // empty: all
  Method method = Method::automatic;
  bool on_controller = false;  // automatic: only what a controller runs itself is taken
  int max_sensors = 0;         // 0: no limit; else the first so many in spread order (budget.h) when the fit chooses
  double coverage = 0.9;       // of the band
};

/// `automatic` compares static and dynamic models on left-out cycles; a simpler one wins unless it is clearly worse.
Result<Model> fit(const std::vector<recording::Recording>& recordings, const FitOptions& options = {},
                  const TaskContext& context = {});

}  // namespace zerodrift::analysis
