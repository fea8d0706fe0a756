#pragma once
// What an analysis that is told the hidden effects would find. Was the case decidable at all: the difference between
// "not found" and "cannot be found" is the evidence that each hidden effect has beside the others. And how well does
// the true structure, re-fitted, predict the recording that was held out: no answer can be expected to do better.

#include <map>
#include <string>
#include <vector>

#include "app/proof/score.h"
#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::proof {

struct OracleAnswer {
  bool found = false;                     // every hidden effect is one that the library has
  double evidence = 0.0;                  // log evidence of the true structure over none
  std::map<std::string, double> beside;   // of each hidden effect beside the others
  std::map<std::string, double> reached;  // rms in the second recording by channel; empty without one
  /// One standard deviation of the place of each hidden effect that has one, mm, from all recordings.
  std::map<std::string, double> place_sigma_mm;
};

/// Fits all recordings jointly, as the diagnosis does.
OracleAnswer told_the_truth(const physics::Machine& machine, const std::vector<recording::Recording>& recordings,
                            const std::vector<TrueEffect>& hidden);

}  // namespace zerodrift::proof
