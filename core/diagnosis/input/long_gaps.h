#pragma once
// What a machine did while nothing was measured is not known: a change of speed at an unknown moment, a stop, an open
// door. A recording with such a gap is diagnosed by its longest part.

#include <optional>
#include <string>

#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

struct LongestPart {
  recording::Recording recording;
  std::string note;  // what was left out and why, in English
};

/// Nothing where no gap is too long: half an hour, or ten minutes and ten samples in which an input changed.
std::optional<LongestPart> longest_part(const recording::Recording& recording);

}  // namespace zerodrift::diagnosis
