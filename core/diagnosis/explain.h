#pragma once
// Sentences a technician understands, from the numbers: ids with their facts (core/diagnosis/sentences.h).

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

Sentence explain_effect(const FoundEffect& effect, const Mismatch& mismatch, double share_removed, double before,
                        const std::string& worst_channel);
Sentence explain_rival(const Rival& rival);
Sentence explain_verdict(const Diagnosis& diagnosis);
/// `run` in English words: "half speed for 3 h without coolant".
Sentence explain_experiment(const std::string& best_effect, const std::string& rival_effect, const std::string& run);

}  // namespace zerodrift::diagnosis
