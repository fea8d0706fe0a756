#pragma once
// The trial as a report: figures against what they must reach, confusion, improvement, calibration, every answer.

#include "app/proof/trial.h"
#include "core/report/report.h"

namespace zerodrift::proof {

report::Report report_of(const Trial& trial);

}  // namespace zerodrift::proof
