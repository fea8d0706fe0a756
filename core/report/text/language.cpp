#include "core/report/text/language.h"

#include <algorithm>
#include <map>
#include <optional>

namespace zerodrift::report {
namespace {

constexpr int deepest = 4;  // a placeholder may hold a sentence with placeholders of its own

/// "{} K from {} s" cut at its placeholders.
struct Pattern {
  std::vector<std::string> literals;  // one more than there are names
  std::vector<std::string> names;     // "0", "1" or the name in braces
  std::string other;
  std::size_t weight = 0;  // of the letters that must fit: the most particular pattern wins
};

Pattern pattern_of(const TextEntry& entry) {
  Pattern pattern;
  pattern.other = entry.chinese;
  const std::string text = entry.english;
  std::size_t at = 0;
  for (;;) {
    const std::size_t open = text.find('{', at);
    const std::size_t close = open == std::string::npos ? open : text.find('}', open);
    if (close == std::string::npos) break;
    pattern.literals.push_back(text.substr(at, open - at));
    const std::string name = text.substr(open + 1, close - open - 1);
    pattern.names.push_back(name.empty() ? std::to_string(pattern.names.size()) : name);
    at = close + 1;
  }
  pattern.literals.push_back(text.substr(at));
  for (const auto& literal : pattern.literals) pattern.weight += literal.size();
  return pattern;
}

struct Catalogue {
  std::map<std::string, std::string> exact;
  std::vector<Pattern> patterns;  // the heaviest first
};

const Catalogue& chinese() {
  static const Catalogue made = [] {
    Catalogue out;
    for (const TextEntry& entry : text_entries()) {
      out.exact.emplace(entry.english, entry.chinese);
      Pattern pattern = pattern_of(entry);
      // Placeholders alone would fit anything.
      if (!pattern.names.empty() && pattern.weight > 0) out.patterns.push_back(std::move(pattern));
    }
    std::stable_sort(out.patterns.begin(), out.patterns.end(),
                     [](const Pattern& a, const Pattern& b) { return a.weight > b.weight; });
    return out;
  }();
  return made;
}

/// What stands at the placeholders when the pattern fits the whole text; the shortest pieces that do.
std::optional<std::vector<std::string>> pieces_of(const Pattern& pattern, const std::string& text) {
  const std::string& first = pattern.literals.front();
  const std::string& last = pattern.literals.back();
  if (text.size() < first.size() + last.size() || !text.starts_with(first) || !text.ends_with(last)) return {};
  std::vector<std::string> pieces;
  std::size_t at = first.size();
  for (std::size_t i = 1; i < pattern.literals.size(); ++i) {
    const bool end = i + 1 == pattern.literals.size();
    const std::size_t next = end ? text.size() - last.size() : text.find(pattern.literals[i], at);
    if (next == std::string::npos || next < at) return {};
    pieces.push_back(text.substr(at, next - at));
    at = next + pattern.literals[i].size();
  }
  return pieces;
}

std::optional<std::string> in_chinese(const std::string& text, int depth);

std::string filled(const Pattern& pattern, const std::vector<std::string>& pieces, int depth) {
  std::string out;
  std::size_t at = 0;
  std::size_t turn = 0;
  const std::string& text = pattern.other;
  for (;;) {
    const std::size_t open = text.find('{', at);
    const std::size_t close = open == std::string::npos ? open : text.find('}', open);
    if (close == std::string::npos) break;
    out += text.substr(at, open - at);
    std::string name = text.substr(open + 1, close - open - 1);
    if (name.empty()) name = std::to_string(turn++);
    const auto found = std::find(pattern.names.begin(), pattern.names.end(), name);
    if (found != pattern.names.end()) {
      const std::string& piece = pieces[static_cast<std::size_t>(found - pattern.names.begin())];
      out += in_chinese(piece, depth - 1).value_or(piece);
    }
    at = close + 1;
  }
  return out + text.substr(at);
}

std::optional<std::string> in_chinese(const std::string& text, int depth) {
  const Catalogue& catalogue = chinese();
  const auto exact = catalogue.exact.find(text);
  if (exact != catalogue.exact.end()) return exact->second;
  if (depth <= 0 || text.empty()) return std::nullopt;
  for (const Pattern& pattern : catalogue.patterns) {
    if (const auto pieces = pieces_of(pattern, text)) return filled(pattern, *pieces, depth);
  }
  return std::nullopt;
}

}  // namespace

Result<Language> language_from(const std::string& code) {
  if (code.empty() || code == "en" || code.starts_with("en-") || code.starts_with("en_")) return Language::english;
  if (code == "zh" || code.starts_with("zh-") || code.starts_with("zh_")) return Language::chinese;
  return fail(ErrorCode::bad_argument, {{"what", "language"}, {"found", code}, {"expected", "en or zh"}});
}

std::string_view code_of(Language language) {
  return language == Language::chinese ? "zh-CN" : "en";
}

std::string translated(Language language, const std::string& english) {
  if (language == Language::english) return english;
  return in_chinese(english, deepest).value_or(english);
}

bool is_known(Language language, const std::string& english) {
  return language == Language::english || in_chinese(english, deepest).has_value();
}

Words words_of(Language language) {
  if (language == Language::english) return {};
  return [language](const std::string& english) { return translated(language, english); };
}

std::vector<TextEntry> text_entries() {
  std::vector<TextEntry> all;
  for (const auto part :
       {texts_of_sections, texts_of_figures, texts_of_doubts, texts_of_physics, texts_of_sentences, texts_of_machine}) {
    const auto entries = part();
    all.insert(all.end(), entries.begin(), entries.end());
  }
  return all;
}

}  // namespace zerodrift::report
