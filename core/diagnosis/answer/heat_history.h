#pragma once
// Where and when heat is missing, before any effect is named: a heat with a free history at a place, scanned along
// every part. The description stays free within its tolerances, the history is smooth as far as the evidence asks.

#include <string>
#include <vector>

#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis::answer {

struct HeatHistory {
  std::string component;
  std::vector<double> position_mm;   // one, 0, of a lump
  std::vector<double> log_evidence;  // of each place, against no such heat
  std::vector<double> time_s;
  std::vector<std::vector<double>> watts;  // [place][time]
  std::size_t best = 0;                    // place

  double best_log_evidence() const { return log_evidence.empty() ? -1e300 : log_evidence[best]; }
};

/// Of each part that can be heated, in one recording.
std::vector<HeatHistory> heat_histories(const inference::Fit& fit, std::size_t run);

}  // namespace zerodrift::diagnosis::answer
