#include "core/base/redact.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <nlohmann/json.hpp>

namespace zerodrift {
namespace {

constexpr std::array<std::string_view, 9> telling = {"password", "passwd",  "passphrase", "pwd",       "secret",
                                                     "token",    "api_key", "apikey",     "credential"};

// Secrets as the whole name of an address's parameter; plain words in a document, where a pin has a place.
constexpr std::array<std::string_view, 4> telling_in_address = {"pass", "pin", "key", "auth"};

std::string lower_of(std::string_view name) {
  std::string lower;
  for (const char c : name) lower += c == '-' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return lower;
}

bool is_secret(std::string_view name) {
  const std::string lower = lower_of(name);
  return std::any_of(telling.begin(), telling.end(),
                     [&](std::string_view word) { return lower.find(word) != std::string::npos; });
}

bool is_secret_parameter(std::string_view name) {
  return is_secret(name) ||
         std::find(telling_in_address.begin(), telling_in_address.end(), lower_of(name)) != telling_in_address.end();
}

bool ends_url(char c) {
  return static_cast<unsigned char>(c) <= ' ' || c == '"' || c == '<' || c == '>';
}

/// "name=value&name=value" with the secret values taken out.
void append_parameters(std::string& out, std::string_view text) {
  while (!text.empty()) {
    const auto end = std::min(text.find_first_of("&;#"), text.size());
    const auto equals = text.substr(0, end).find('=');
    if (equals != std::string_view::npos && is_secret_parameter(text.substr(0, equals))) {
      out += text.substr(0, equals + 1);
      out += redacted_mark;
    } else {
      out += text.substr(0, end);
    }
    if (end < text.size()) out += text[end];
    text.remove_prefix(std::min(end + 1, text.size()));
  }
}

/// What stands after "://" up to the end of the URL.
void append_rest(std::string& out, std::string_view rest) {
  // A password may hold a '/' that nobody escaped: the last '@' before the parameters ends it all the same.
  const auto query = std::min(rest.find('?'), rest.size());
  auto at = rest.substr(0, query).rfind('@');
  if (at == std::string_view::npos && query < rest.size()) at = rest.find('@') < rest.find('/') ? rest.rfind('@') : at;
  if (at != std::string_view::npos) {
    const auto colon = rest.substr(0, at).find(':');
    out += rest.substr(0, std::min(colon, at));
    if (colon != std::string_view::npos && colon < at) {
      out += ':';
      out += redacted_mark;
    }
    out += '@';
    rest.remove_prefix(at + 1);
  }
  const auto mark = std::min(rest.find('?'), rest.size());
  out += rest.substr(0, mark);
  if (mark == rest.size()) return;
  out += '?';
  append_parameters(out, rest.substr(mark + 1));
}

/// Every address in a text.
std::string clean_addresses(std::string_view text) {
  std::string out;
  for (;;) {
    const auto scheme = text.find("://");
    if (scheme == std::string_view::npos) break;
    out += text.substr(0, scheme + 3);
    text.remove_prefix(scheme + 3);
    const auto end = static_cast<std::size_t>(std::find_if(text.begin(), text.end(), ends_url) - text.begin());
    append_rest(out, text.substr(0, end));
    text.remove_prefix(end);
  }
  out += text;
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
    if (value >= text.size() || !is_secret(text.substr(key + 1, key_end - key - 2))) continue;
    const std::size_t end = value_end(text, value);
    if (text.substr(value, 4) == "null") continue;
    if (end == std::string_view::npos) break;
    out += std::string(text.substr(key_end, value - key_end)) + "\"" + std::string(redacted_mark) + "\"";
    from = end;
  }
  return out + std::string(text.substr(from));
}

}  // namespace

std::string without_secrets(std::string_view text) {
  return clean_keys(clean_addresses(text));
}

nlohmann::json document_without_secrets(const nlohmann::json& document) {
  nlohmann::json out = document;
  if (out.is_string()) return without_secrets(out.get_ref<const std::string&>());
  if (out.is_array()) {
    for (auto& item : out) item = document_without_secrets(std::as_const(item));
  }
  if (!out.is_object()) return out;
  for (auto& [key, value] : out.items()) {
    const bool hidden = is_secret(key) && !value.is_null();
    value = hidden ? nlohmann::json(redacted_mark) : document_without_secrets(std::as_const(value));
  }
  return out;
}

bool lacks_secret(std::string_view url) {
  return url.find(redacted_mark) != std::string_view::npos;
}

}  // namespace zerodrift
