#pragma once
// The report in the reader's language. The English text is the key: a text is an entry of the catalogue, or an entry
// with placeholders that fits it ("{} K from {} s" fits "0.3 K from 20 s"), which is how sentences that other parts of
// core have composed and stored in the job are said in another language. Terms follow GB/T 17421 and ISO 230.

#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/report/report.h"

namespace zerodrift::report {

enum class Language { english, chinese };

/// "en" or "zh"; bad_argument naming both.
Result<Language> language_from(const std::string& code);
std::string_view code_of(Language language);  // "en", "zh-CN"
/// The text in that language; the English one when the catalogue has none.
std::string translated(Language language, const std::string& english);
/// Whether the catalogue has the text or a pattern that fits it.
bool is_known(Language language, const std::string& english);
/// translated() as a function, null for English.
Words words_of(Language language);

/// An English text and what it is in the other languages. Placeholders: {} in turn or {name}; the other language may
/// put them elsewhere as {0}, {1} or {name}.
struct TextEntry {
  const char* english;
  const char* chinese;
};
/// Every entry, for tests.
std::vector<TextEntry> text_entries();

// The parts of the catalogue, one a file.
std::vector<TextEntry> texts_of_sections();
std::vector<TextEntry> texts_of_figures();
std::vector<TextEntry> texts_of_doubts();
std::vector<TextEntry> texts_of_physics();
std::vector<TextEntry> texts_of_sentences();
std::vector<TextEntry> texts_of_machine();

}  // namespace zerodrift::report
