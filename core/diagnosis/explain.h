#pragma once
// Sentences a technician understands, from the numbers. Each is an id with its facts, so that every language can say
// it; the English text is made here for JSON and logs.

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

Sentence explain_effect(const FoundEffect& effect, const Mismatch& mismatch, double share_removed, double before,
                        const std::string& worst_channel);
Sentence explain_rival(const Rival& rival);
Sentence explain_verdict(const Diagnosis& diagnosis);
/// "convection to the room", "an extra heat source" ...
std::string plain_name(const std::string& effect_id);

}  // namespace zerodrift::diagnosis
