#include "core/base/json.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/file.h"

namespace zerodrift {

using nlohmann::json;

namespace {

std::string shown(const json& value) {
  return shortened(json_text(value));
}

/// The library's sentence without its own name and position: what was found and what was expected.
std::string words_of(const json::exception& error) {
  std::string text = error.what();
  for (const std::string_view before : {std::string_view("] "), std::string_view("syntax error ")}) {
    const std::size_t at = text.find(before);
    if (at != std::string::npos) text = text.substr(at + before.size());
  }
  // It quotes all of the value at which it stopped.
  constexpr std::string_view quote = "read: '";
  if (const std::size_t at = text.find(quote); at != std::string::npos) {
    const std::size_t begin = at + quote.size();
    const std::size_t end = std::max(text.rfind('\''), begin);
    text = text.substr(0, begin) + shortened(text.substr(begin, end - begin)) + text.substr(end);
  }
  return text;
}

// Far beyond any document of ours, far below where walking through one would end the stack.
constexpr int deepest = 200;

/// The line where brackets first nest deeper than that; 0 when they never do.
std::int64_t line_too_deep(std::string_view text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      quoted = c != '"';
      continue;
    }
    quoted = c == '"';
    if (c == '[' || c == '{') ++depth;
    if (c == ']' || c == '}') --depth;
    if (depth > deepest) return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(i), '\n');
  }
  return 0;
}

}  // namespace

std::string json_text(const json& value, int indent) {
  return value.dump(indent, ' ', false, json::error_handler_t::replace);
}

JsonObject::JsonObject(const json& value, std::string file, std::string path)
    : m_value(&value), m_file(std::move(file)), m_path(std::move(path)) {
  if (!value.is_object()) {
    throw JsonFault{{ErrorCode::json_bad_value,
                     {{"file", m_file},
                      {"key", m_path.empty() ? "(document)" : m_path},
                      {"found", shown(value)},
                      {"expected", "an object"}}}};
  }
}

std::string JsonObject::full(std::string_view key) const {
  return m_path.empty() ? std::string(key) : m_path + "." + std::string(key);
}

const json* JsonObject::find(std::string_view key) {
  m_asked.emplace(key);
  const auto at = m_value->find(key);
  return at == m_value->end() || at->is_null() ? nullptr : &*at;
}

bool JsonObject::has(std::string_view key) const {
  const auto at = m_value->find(key);
  return at != m_value->end() && !at->is_null();
}

void JsonObject::reject(std::string_view key, std::string found, std::string expected) const {
  throw JsonFault{{ErrorCode::json_bad_value,
                   {{"file", m_file},
                    {"key", full(key)},
                    {"found", shortened(std::move(found))},
                    {"expected", std::move(expected)}}}};
}

void JsonObject::missing(std::string_view key, std::string expected) const {
  throw JsonFault{
      {ErrorCode::json_missing_key, {{"file", m_file}, {"key", full(key)}, {"expected", std::move(expected)}}}};
}

double JsonObject::checked(std::string_view key, const json& value, NumberRange range) const {
  if (!value.is_number()) reject(key, shown(value), std::string(range.words));
  const double number = value.get<double>();
  const bool above = range.low_open ? number > range.low : number >= range.low;
  if (!std::isfinite(number) || !above || number > range.high) reject(key, shown(value), std::string(range.words));
  return number;
}

std::optional<double> JsonObject::number_if(std::string_view key, NumberRange range) {
  const json* value = find(key);
  if (value == nullptr) return std::nullopt;
  return checked(key, *value, range);
}

double JsonObject::number(std::string_view key, NumberRange range) {
  const auto value = number_if(key, range);
  if (!value) missing(key, std::string(range.words));
  return *value;
}

double JsonObject::number_or(std::string_view key, double fallback, NumberRange range) {
  return number_if(key, range).value_or(fallback);
}

int JsonObject::integer(std::string_view key, int low, int high) {
  const std::string words = "a whole number from " + std::to_string(low) + " to " + std::to_string(high);
  const double value = number(key, NumberRange{double(low), double(high), false, words});
  if (value != std::floor(value)) reject(key, shown(*find(key)), words);
  return static_cast<int>(value);
}

int JsonObject::integer_or(std::string_view key, int fallback, int low, int high) {
  return find(key) == nullptr ? fallback : integer(key, low, high);
}

bool JsonObject::flag_or(std::string_view key, bool fallback) {
  const json* value = find(key);
  if (value == nullptr) return fallback;
  if (!value->is_boolean()) reject(key, shown(*value), "true or false");
  return value->get<bool>();
}

std::string JsonObject::text(std::string_view key) {
  const json* value = find(key);
  if (value == nullptr) missing(key, "a text");
  if (!value->is_string()) reject(key, shown(*value), "a text");
  return value->get<std::string>();
}

std::string JsonObject::text_or(std::string_view key, std::string fallback) {
  return find(key) == nullptr ? std::move(fallback) : text(key);
}

std::string JsonObject::word(std::string_view key, const std::vector<std::string>& allowed) {
  std::string list;
  for (const auto& one : allowed) list += (list.empty() ? "" : ", ") + one;
  if (find(key) == nullptr) missing(key, "one of " + list);
  std::string value = text(key);
  if (std::find(allowed.begin(), allowed.end(), value) == allowed.end()) reject(key, value, "one of " + list);
  return value;
}

std::vector<double> JsonObject::numbers(std::string_view key, std::size_t count) {
  const std::string words = count == 0 ? "a list of numbers" : "a list of " + std::to_string(count) + " numbers";
  const json* value = find(key);
  if (value == nullptr) missing(key, words);
  if (!value->is_array() || (count != 0 && value->size() != count)) reject(key, shown(*value), words);
  std::vector<double> out;
  for (std::size_t i = 0; i < value->size(); ++i) {
    out.push_back(checked(std::string(key) + "[" + std::to_string(i) + "]", (*value)[i], any_number));
  }
  return out;
}

std::vector<double> JsonObject::numbers_or_empty(std::string_view key) {
  return find(key) == nullptr ? std::vector<double>{} : numbers(key);
}

std::vector<std::string> JsonObject::texts_or_empty(std::string_view key) {
  const json* value = find(key);
  if (value == nullptr) return {};
  if (!value->is_array()) reject(key, shown(*value), "a list of texts");
  std::vector<std::string> out;
  for (const auto& one : *value) {
    if (!one.is_string()) reject(key, shown(one), "a list of texts");
    out.push_back(one.get<std::string>());
  }
  return out;
}

JsonObject* JsonObject::object_if(std::string_view key) {
  const json* value = find(key);
  if (value == nullptr) return nullptr;
  m_children.emplace_back();
  return &m_children.back().emplace_back(*value, m_file, full(key));
}

JsonObject& JsonObject::object(std::string_view key) {
  JsonObject* child = object_if(key);
  if (child == nullptr) missing(key, "an object");
  return *child;
}

std::deque<JsonObject>& JsonObject::objects_or_empty(std::string_view key) {
  const json* value = find(key);
  auto& list = m_children.emplace_back();
  if (value == nullptr) return list;
  if (!value->is_array()) reject(key, shown(*value), "a list of objects");
  for (std::size_t i = 0; i < value->size(); ++i) {
    list.emplace_back((*value)[i], m_file, full(key) + "[" + std::to_string(i) + "]");
  }
  return list;
}

std::deque<JsonObject>& JsonObject::objects(std::string_view key) {
  if (find(key) == nullptr) missing(key, "a list of objects");
  return objects_or_empty(key);
}

std::vector<std::string> JsonObject::keys() const {
  std::vector<std::string> out;
  for (const auto& [key, value] : m_value->items()) out.push_back(key);
  return out;
}

const json* JsonObject::raw(std::string_view key) {
  return find(key);
}

void JsonObject::unknown_keys(std::vector<std::string>& out) const {
  for (const auto& [key, value] : m_value->items()) {
    if (!m_asked.contains(key)) out.push_back(m_file + ": unknown key \"" + full(key) + "\" is kept and ignored");
  }
  for (const auto& list : m_children) {
    for (const auto& child : list) child.unknown_keys(out);
  }
}

Result<json> parse_json(std::string_view text, const std::string& file) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (const auto line = line_too_deep(text); line > 0) {
    return fail(ErrorCode::json_syntax, {{"file", file},
                                         {"line", std::to_string(line)},
                                         {"column", "1"},
                                         {"detail", "brackets within brackets, more than " + std::to_string(deepest)}});
  }
  try {
    return json::parse(text);
  } catch (const json::parse_error& error) {
    const std::size_t at = std::min<std::size_t>(error.byte, text.size());
    const auto before = text.substr(0, at == 0 ? 0 : at - 1);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::size_t newline = before.rfind('\n');
    const std::size_t column = newline == std::string_view::npos ? before.size() + 1 : before.size() - newline;
    return fail(ErrorCode::json_syntax, {{"file", file},
                                         {"line", std::to_string(line)},
                                         {"column", std::to_string(column)},
                                         {"detail", words_of(error)}});
  } catch (const json::exception& error) {  // numbers out of range
    return fail(ErrorCode::json_syntax, {{"file", file}, {"line", "1"}, {"column", "1"}, {"detail", words_of(error)}});
  }
}

Result<json> read_json_file(const std::filesystem::path& path) {
  ZD_TRY(const std::string text, read_file(path));
  return parse_json(text, path.string());
}

Status write_json_file(const std::filesystem::path& path, const json& value) {
  return write_file(path, json_text(value, 2) + "\n");
}

Status read_object(const json& document, const std::string& file, std::vector<std::string>* warnings,
                   const std::function<void(JsonObject&)>& reader) {
  try {
    JsonObject root(document, file, "");
    reader(root);
    if (warnings != nullptr) root.unknown_keys(*warnings);
    return {};
  } catch (const JsonFault& fault) {
    return fail(fault.error);
  }
}

}  // namespace zerodrift
