#pragma once
// The catalogue of sentences: what is stored is an id and its facts; the words are made where they are read, in the
// reader's language. A fact in braces is put in as it is; {@fact} is itself an entry of the catalogue or a text in
// English to be said in the reader's language; {+fact} is a list of such entries, joined by "and",
// {|fact} one joined by "or".

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

/// From an English text of the catalogue to the reader's language.
using Translate = std::function<std::string(const std::string&)>;

/// The sentence in words; without `translate` in English. Empty for an unknown id.
std::string said(const Sentence& sentence, const Translate& translate = {});
/// "convection to the room": the English name of an effect, or the id with blanks.
std::string plain_name(const std::string& effect_id);
/// Every English text of the catalogue, for translators and tests.
std::vector<std::string> sentence_texts();

nlohmann::json to_json(const Sentence& sentence);
Sentence sentence_from_json(const nlohmann::json& document);

}  // namespace zerodrift::diagnosis
