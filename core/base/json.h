#pragma once
// Reading JSON documents by the contract: unknown keys are kept and warned of, missing or wrong ones are errors that
// name file, key and what is expected.
//
//   Result<Plan> plan = read_json<Plan>(path, warnings, [](JsonObject& o) {
//     Plan p;
//     p.name = o.text_or("name", "");
//     for (JsonObject& s : o.objects("steps")) p.steps.push_back({s.number("duration_s", positive) ...});
//     return p;
//   });
//
// Inside the callback a fault is thrown as JsonFault and turned into an Error at the border; nothing else leaks out.

#include <deque>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"

namespace zerodrift {

struct JsonFault {
  Error error;
};

/// A range a number must lie in; finite always.
struct NumberRange {
  double low;
  double high;
  bool low_open = false;   // low itself is not allowed
  std::string_view words;  // for the message, for example "a number above 0"
};
inline constexpr NumberRange any_number{-1e300, 1e300, false, "a number"};
inline constexpr NumberRange positive{0.0, 1e300, true, "a number above 0"};
inline constexpr NumberRange not_negative{0.0, 1e300, false, "a number of 0 or more"};

/// The document as text, indented by so many spaces (-1: in one line). Names and notes of files from elsewhere may hold
/// bytes that are no UTF-8; each becomes U+FFFD, where the library's own dump() would throw. The only way out.
std::string json_text(const nlohmann::json& value, int indent = -1);

class JsonObject {
 public:
  JsonObject(const nlohmann::json& value, std::string file, std::string path);

  bool has(std::string_view key) const;  // there and not null
  double number(std::string_view key, NumberRange range = any_number);
  double number_or(std::string_view key, double fallback, NumberRange range = any_number);
  std::optional<double> number_if(std::string_view key, NumberRange range = any_number);
  int integer(std::string_view key, int low, int high);
  int integer_or(std::string_view key, int fallback, int low, int high);
  bool flag_or(std::string_view key, bool fallback);
  std::string text(std::string_view key);
  std::string text_or(std::string_view key, std::string fallback);
  /// One of the words given, else an error that lists them.
  std::string word(std::string_view key, const std::vector<std::string>& allowed);
  std::vector<double> numbers(std::string_view key, std::size_t count = 0);  // count 0: any
  std::vector<double> numbers_or_empty(std::string_view key);
  std::vector<std::string> texts_or_empty(std::string_view key);
  JsonObject& object(std::string_view key);
  JsonObject* object_if(std::string_view key);
  std::deque<JsonObject>& objects(std::string_view key);  // required array of objects
  std::deque<JsonObject>& objects_or_empty(std::string_view key);
  /// The keys of the object, for maps from names to values.
  std::vector<std::string> keys() const;
  /// Marks a key as known without reading it.
  const nlohmann::json* raw(std::string_view key);

  /// Throws json_bad_value for this key; for rules that a range cannot say.
  [[noreturn]] void reject(std::string_view key, std::string found, std::string expected) const;
  /// Throws json_missing_key.
  [[noreturn]] void missing(std::string_view key, std::string expected) const;
  /// Adds "key" for every key never asked for, here and below.
  void unknown_keys(std::vector<std::string>& out) const;
  const nlohmann::json& value() const { return *m_value; }

 private:
  const nlohmann::json* find(std::string_view key);
  std::string full(std::string_view key) const;
  double checked(std::string_view key, const nlohmann::json& value, NumberRange range) const;

  const nlohmann::json* m_value;
  std::string m_file;
  std::string m_path;
  std::set<std::string, std::less<>> m_asked;
  std::deque<std::deque<JsonObject>> m_children;
};

/// Reads and parses; a syntax error names line and column. `file` is only a name for messages in the text form.
Result<nlohmann::json> parse_json(std::string_view text, const std::string& file);
Result<nlohmann::json> read_json_file(const std::filesystem::path& path);
/// Indented by two, ends with a newline; atomic. NaN and infinity are written as null.
Status write_json_file(const std::filesystem::path& path, const nlohmann::json& value);

/// The border: runs the reader on the document's root object; faults become errors, unknown keys become warnings.
Status read_object(const nlohmann::json& document, const std::string& file, std::vector<std::string>* warnings,
                   const std::function<void(JsonObject&)>& reader);

template <class T, class Reader>
Result<T> from_json(const nlohmann::json& document, const std::string& file, std::vector<std::string>* warnings,
                    Reader reader) {
  std::optional<T> value;
  ZD_CHECK(read_object(document, file, warnings, [&](JsonObject& object) { value.emplace(reader(object)); }));
  return std::move(*value);
}

}  // namespace zerodrift
