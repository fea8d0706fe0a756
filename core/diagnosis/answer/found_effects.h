#pragma once
// The effects that are named: those of the best explanation that carry more than half of the probability and take more
// than a detail.

#include "core/diagnosis/answer/posterior_summary.h"

namespace zerodrift::diagnosis::answer {

/// The best supported first. `channels`: of channel_reports().
std::vector<FoundEffect> found_effects(const PosteriorSummary& summary, const std::vector<ChannelReport>& channels);

}  // namespace zerodrift::diagnosis::answer
