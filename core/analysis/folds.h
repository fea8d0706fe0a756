#pragma once
// What is left out to judge a model: whole cycles, never random rows. Neighbouring rows of a slow process are nearly
// the same row; leaving single ones out judges the memory of a model, not its knowledge.

#include <string>
#include <vector>

#include "core/analysis/prepare.h"

namespace zerodrift::analysis {

struct Folds {
  std::vector<int> fold_of;  // of each sample; -1: always in training
  int count = 0;
  int cycles = 1;        // independent stretches found
  std::string in_words;  // what is left out in turn
};

/// Start rows of the cycles of a run: a heating-up from standstill after at least half an hour, or else a plateau of
/// another speed of at least twenty minutes. The first is row 0.
std::vector<int> cycle_starts(const Prepared& data);

/// Several cycles or runs: each in turn. One: its last quarter.
Folds make_folds(const std::vector<const Prepared*>& runs, const std::vector<const Samples*>& samples);

}  // namespace zerodrift::analysis
