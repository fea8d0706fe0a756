#pragma once
// When something is missing, by the inputs that the recording has: the one that it follows best.

#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

/// What changes with time: the mean over a block about each of the times.
struct History {
  std::vector<double> time_s;
  std::vector<double> value;
};
/// "while the spindle turns", "while the coolant runs" ... the input that what is missing follows best.
std::string regime_of(const History& missing, const recording::Recording& recording);

}  // namespace zerodrift::diagnosis
