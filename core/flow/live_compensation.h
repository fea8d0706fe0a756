#pragma once
// The host compensator (C1) with the model of a job, and beside it what is left (C2): whenever the machine stands where
// the camera was calibrated, the error that remains is measured, from the zero of the warm-up run. However it ends, the
// offset is run to 0 and the switch is put back to where it was found, or compensation_left says what the machine
// holds.

#include <functional>
#include <optional>
#include <string>

#include "core/access/permit.h"
#include "core/acquisition/error_source.h"
#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/controller/host_compensator.h"
#include "core/controller/profile.h"

namespace zerodrift::flow {

struct LiveOptions {
  access::Permit permit = access::Permit::read_only();  // without one the first write is refused
  double period_s = 0.5;                                // host seconds between two turns
  double measure_every_s = 2.0;                         // host seconds between two measurements
  double there_mm = 0.01;  // from the measuring position, on each axis: near enough to measure
};

struct LiveTurn {
  controller::CompensatorTurn turn;
  std::optional<acquisition::ErrorSample> left;  // measured since the last turn: error = actual - commanded
  std::string not_measured;                      // why nothing is measured now; "" when it is
};

/// Until stopped. step_blocked without a model; data_does_not_fit when another machine is connected than the job's, or
/// when the controller's own table compensates already. Starting, and how it ended, are in the job's audit trail.
Result<controller::CompensatorSummary> compensate_live(commissioning::Job& job, const controller::Profile& profile,
                                                       const LiveOptions& options, const TaskContext& context,
                                                       const std::function<void(const LiveTurn&)>& observer);

}  // namespace zerodrift::flow
