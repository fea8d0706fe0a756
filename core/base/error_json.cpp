#include "core/base/error_json.h"

#include <nlohmann/json.hpp>

namespace zerodrift {
namespace {

std::optional<ErrorCode> code_named(std::string_view name) {
  for (int i = 0; i < error_code_count(); ++i) {
    if (name_of(static_cast<ErrorCode>(i)) == name) return static_cast<ErrorCode>(i);
  }
  return std::nullopt;
}

/// Where " key=" begins at or after `from`; npos: nowhere.
std::size_t next_key(std::string_view line, std::size_t from) {
  for (std::size_t at = line.find(' ', from); at != std::string_view::npos; at = line.find(' ', at + 1)) {
    const std::size_t end = line.find_first_not_of("abcdefghijklmnopqrstuvwxyz_", at + 1);
    if (end != std::string_view::npos && end > at + 1 && line[end] == '=') return at;
  }
  return std::string_view::npos;
}

}  // namespace

nlohmann::json to_json(const Error& error) {
  return {{"code", std::string(name_of(error.code))}, {"context", error.context}};
}

std::optional<Error> error_from_json(const nlohmann::json& value) {
  if (!value.is_object()) return std::nullopt;
  const auto code = value.find("code");
  if (code == value.end() || !code->is_string()) return std::nullopt;
  Error error{ErrorCode::internal, {{"detail", code->get<std::string>()}}};
  if (const auto known = code_named(code->get<std::string>())) error = {*known, {}};
  const auto context = value.find("context");
  if (context == value.end() || !context->is_object()) return error;
  for (const auto& [key, fact] : context->items()) {
    if (fact.is_string()) error.context[key] = fact.get<std::string>();
  }
  return error;
}

std::optional<Error> error_described(std::string_view line) {
  const auto code = code_named(line.substr(0, line.find(' ')));
  if (!code) return std::nullopt;
  Error error{*code, {}};
  std::size_t at = line.find(' ');
  if (at != next_key(line, 0)) return std::nullopt;
  while (at < line.size()) {
    const std::size_t equals = line.find('=', at);
    const std::size_t next = next_key(line, equals);
    error.context.emplace(line.substr(at + 1, equals - at - 1), line.substr(equals + 1, next - equals - 1));
    at = next;
  }
  return error;
}

}  // namespace zerodrift
