#pragma once
// Two runs over the same minutes since their starts: a peak grows with the length of a run, so runs of unequal length
// are only compared as far as both go.

#include <string>
#include <vector>

#include "core/recording/recording.h"

namespace zerodrift::report {

struct AxisComparison {
  std::string axis;        // "X"
  double before_um = 0.0;  // largest |error|
  double after_um = 0.0;
  double before_rms_um = 0.0;
  double after_rms_um = 0.0;
  double end_before_um = 0.0;  // mean |error| of the last tenth of the span
  double end_after_um = 0.0;
  double removed_percent = 0.0;  // of the largest; negative: made worse

  bool worse() const { return after_um > before_um; }
  bool worse_at_the_end() const { return end_after_um > end_before_um; }
};

struct Comparison {
  double span_s = 0.0;               // of each run, from its start
  std::vector<AxisComparison> axes;  // those measured in both
};

Comparison compare_runs(const recording::Recording& before, const recording::Recording& after);

}  // namespace zerodrift::report
