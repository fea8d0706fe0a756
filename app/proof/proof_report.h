#pragma once
// The trial as a report: figures against what they must reach, confusion, improvement, calibration, every answer.

#include <optional>

#include "app/proof/experiments.h"
#include "app/proof/trial.h"
#include "core/report/report.h"

namespace zerodrift::proof {

/// `experiments` is left out when there was none.
report::Report report_of(const Trial& trial, const std::optional<ExperimentTrial>& experiments);

}  // namespace zerodrift::proof
