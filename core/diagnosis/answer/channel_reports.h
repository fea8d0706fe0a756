#pragma once
// Each channel's verdict: measured, simulated as described, the description re-fitted, and the explanation.

#include "core/diagnosis/answer/weighed.h"

namespace zerodrift::diagnosis::answer {

/// In the order of weighed.reported(); `refined`: the explanation as a machine.
std::vector<ChannelReport> channel_reports(const Weighed& weighed, const physics::Machine& refined);

}  // namespace zerodrift::diagnosis::answer
