#include "core/base/error_json.h"

#include <nlohmann/json.hpp>

namespace zerodrift {

nlohmann::json to_json(const Error& error) {
  return {{"code", std::string(name_of(error.code))}, {"context", error.context}};
}

std::optional<Error> error_from_json(const nlohmann::json& value) {
  if (!value.is_object()) return std::nullopt;
  const auto code = value.find("code");
  if (code == value.end() || !code->is_string()) return std::nullopt;
  Error error{ErrorCode::internal, {{"detail", code->get<std::string>()}}};
  for (int i = 0; i < error_code_count(); ++i) {
    if (name_of(static_cast<ErrorCode>(i)) != code->get<std::string>()) continue;
    error = {static_cast<ErrorCode>(i), {}};
  }
  const auto context = value.find("context");
  if (context == value.end() || !context->is_object()) return error;
  for (const auto& [key, fact] : context->items()) {
    if (fact.is_string()) error.context[key] = fact.get<std::string>();
  }
  return error;
}

}  // namespace zerodrift
