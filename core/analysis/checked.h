#pragma once
// The one check of a recording that everything asks which learns from it - regression, diagnosis, placing - so that no
// path takes a unit or a lying sensor for the machine. What is wrong is named; temperatures leave in C.

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/analysis/findings.h"
#include "core/base/result.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis {

/// Temperature series as they came: units converted, spikes made missing (both into `findings`), and for each series
/// the fault that makes it useless, if there is one.
std::vector<std::optional<Finding>> check_temperatures(const std::vector<std::string>& channels,
                                                       const std::vector<double>& time_s,
                                                       std::vector<std::vector<double>>& values,
                                                       std::vector<Finding>& findings);

struct Checked {
  recording::Recording recording;
  std::vector<Finding> findings;
};

/// For what can do with holes and with series that end early: samples stay as they are but for their unit and for
/// dropouts, and a channel that lies - stood still while it should move, out of reach, empty - is taken out.
/// `may_stand_still`: what a thermostat may hold for hours, a chiller say.
Checked checked(const recording::Recording& recording, const std::set<std::string>& may_stand_still = {});

/// One run given twice is neither trained on twice nor held out.
Status check_distinct(const std::vector<recording::Recording>& recordings);
/// Errors that cannot be in micrometres for how far the temperatures move: the whole recording is refused.
Status check_error_unit(const recording::Recording& recording);
/// Times that cannot be in seconds for how fast all gets warm.
std::optional<Finding> doubtful_times(const recording::Recording& recording);

}  // namespace zerodrift::analysis
