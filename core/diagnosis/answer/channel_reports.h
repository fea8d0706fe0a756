#pragma once
// Each channel's verdict: measured, simulated as described, the description re-fitted, and the explanation.

#include "core/diagnosis/answer/posterior_summary.h"

namespace zerodrift::diagnosis::answer {

/// In the order of summary.reported(); `refined`: the explanation as a machine.
std::vector<ChannelReport> channel_reports(const PosteriorSummary& summary, const physics::Machine& refined);

}  // namespace zerodrift::diagnosis::answer
