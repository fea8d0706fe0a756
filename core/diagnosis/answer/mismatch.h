#pragma once
// Where and when the description differs from the recordings: the worst channels, the heat that is missing with its
// place and times.

#include "core/diagnosis/answer/posterior_summary.h"

namespace zerodrift::diagnosis::answer {

/// After the channels' reports: sets `mismatch`, `heat`, and each channel's times and watts.
void report_mismatch(const PosteriorSummary& summary, Diagnosis& answer);

}  // namespace zerodrift::diagnosis::answer
