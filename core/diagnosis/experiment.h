#pragma once
// Which short run would tell two rivals apart: from a library of runs, the one in which their predictions differ most
// in noise widths per hour.

#include <memory>
#include <optional>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model.h"

namespace zerodrift::diagnosis {

SuggestedExperiment suggest_experiment(const Model& best, const Model& rival);

}  // namespace zerodrift::diagnosis
