#pragma once
// Sentences a technician understands, from the numbers: ids with their facts (core/diagnosis/sentences.h).

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

Sentence explain_effect(const FoundEffect& effect, const Mismatch& mismatch, double share_removed, double before,
                        const std::string& worst_channel);
Sentence explain_rival(const Rival& rival);
Sentence explain_verdict(const Diagnosis& diagnosis);
/// "h = 12.7 ± 0.7 W/m²K": a parameter of an effect with a sign that is the same in every language; sigma 0: unknown.
/// Empty for what is not shown (cosines, logarithms).
std::string parameter_in_words(const std::string& key, double value, double sigma);
/// Of effects that this recording would have shown only at an impossible size.
/// A sentence of the catalogue with its facts.
Sentence explain_note(const std::string& id, std::map<std::string, std::string> facts = {});
Sentence explain_unseen(const std::vector<std::string>& effects);
/// `run` in English words: "half speed without coolant"; how long it takes in all.
Sentence explain_experiment(const std::string& best_effect, const std::string& rival_effect, const std::string& run,
                            int minutes);

}  // namespace zerodrift::diagnosis
