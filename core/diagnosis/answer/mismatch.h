#pragma once
// Where and when the description differs from the recordings: the worst channels, the heat that is missing with its
// place and times.

#include "core/diagnosis/answer/weighed.h"

namespace zerodrift::diagnosis::answer {

/// After the channels' reports: sets `mismatch`, `heat`, and each channel's times and watts.
void tell_mismatch(const Weighed& weighed, Diagnosis& answer);

}  // namespace zerodrift::diagnosis::answer
