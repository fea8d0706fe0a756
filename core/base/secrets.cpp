#include "core/base/secrets.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace zerodrift {
namespace {

constexpr std::array<std::string_view, 9> telling = {"password", "passwd",  "passphrase", "pwd",       "secret",
                                                     "token",    "api_key", "apikey",     "credential"};

bool names_a_secret(std::string_view key) {
  std::string lower;
  for (const char c : key) lower += c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return std::any_of(telling.begin(), telling.end(),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

bool ends_address(char c) {
  return std::isspace(static_cast<unsigned char>(c)) != 0 || c == '"' || c == '\'' || c == '<' || c == '>' || c == '\\';
}

/// From the text after "://": the name and password before "@", and the parameters after "?", are replaced.
std::string clean_address(std::string_view rest) {
  const std::size_t host_end = std::min(rest.find_first_of("/?#"), rest.size());
  const std::size_t at = rest.substr(0, host_end).rfind('@');
  std::string out;
  if (at != std::string_view::npos) {
    out = std::string(removed_secret) + "@";
    rest.remove_prefix(at + 1);
  }
  std::size_t from = 0;
  while (from < rest.size()) {
    const std::size_t end = std::min(rest.find_first_of("?&", from), rest.size());
    const std::string_view part = rest.substr(from, end - from);
    const std::size_t equals = part.find('=');
    const bool secret = from > 0 && equals != std::string_view::npos && names_a_secret(part.substr(0, equals));
    out += secret ? std::string(part.substr(0, equals + 1)) + std::string(removed_secret) : std::string(part);
    if (end < rest.size()) out += rest[end];
    from = end + 1;
  }
  return out;
}

/// One past the closing quotation mark of the JSON string that begins at `from`; npos when there is none.
std::size_t string_end(std::string_view text, std::size_t from) {
  for (std::size_t i = from + 1; i < text.size(); ++i) {
    if (text[i] == '\\') {
      ++i;
    } else if (text[i] == '"') {
      return i + 1;
    }
  }
  return std::string_view::npos;
}

/// One past a JSON value that begins at `from`, lists and objects with all that is in them.
std::size_t value_end(std::string_view text, std::size_t from) {
  int depth = 0;
  for (std::size_t i = from; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '"') {
      i = string_end(text, i);
      if (i == std::string_view::npos) return i;
      if (depth == 0) return i;
      --i;
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if (c == '}' || c == ']') {
      if (depth == 0) return i;
      if (--depth == 0) return i + 1;
    } else if (depth == 0 && c == ',') {
      return i;
    }
  }
  return text.size();
}

std::string clean_addresses(std::string_view text) {
  std::string out;
  std::size_t from = 0;
  for (;;) {
    const std::size_t scheme = text.find("://", from);
    if (scheme == std::string_view::npos) break;
    const std::size_t begin = scheme + 3;
    std::size_t end = begin;
    while (end < text.size() && !ends_address(text[end])) ++end;
    out += text.substr(from, begin - from);
    out += clean_address(text.substr(begin, end - begin));
    from = end;
  }
  return out + std::string(text.substr(from));
}

std::string clean_keys(std::string_view text) {
  std::string out;
  std::size_t from = 0;
  for (;;) {
    const std::size_t key = text.find('"', from);
    const std::size_t key_end = key == std::string_view::npos ? key : string_end(text, key);
    if (key_end == std::string_view::npos) break;
    out += text.substr(from, key_end - from);
    from = key_end;
    std::size_t value = key_end;
    while (value < text.size() && std::isspace(static_cast<unsigned char>(text[value])) != 0) ++value;
    if (value >= text.size() || text[value] != ':') continue;  // a value, no key
    ++value;
    while (value < text.size() && std::isspace(static_cast<unsigned char>(text[value])) != 0) ++value;
    if (value >= text.size() || !names_a_secret(text.substr(key + 1, key_end - key - 2))) continue;
    const std::size_t end = value_end(text, value);
    if (text.substr(value, 4) == "null") continue;
    if (end == std::string_view::npos) break;
    out += std::string(text.substr(key_end, value - key_end)) + "\"" + std::string(removed_secret) + "\"";
    from = end;
  }
  return out + std::string(text.substr(from));
}

}  // namespace

std::string without_secrets(std::string_view text) {
  return clean_keys(clean_addresses(text));
}

}  // namespace zerodrift
