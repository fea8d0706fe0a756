#include "core/commissioning/audit_words.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace zerodrift::commissioning {

std::string value_in_short(const std::string& value) {
  if (value.empty() || value.front() != '{') return value;
  const auto document = nlohmann::json::parse(value, nullptr, false);
  const bool has_version = document.is_object() && document.contains("version") && document["version"].is_number();
  return has_version ? fmt::format("version {}", document["version"].get<int>()) : value;
}

}  // namespace zerodrift::commissioning
