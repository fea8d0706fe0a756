#include "core/base/json_path.h"

namespace zerodrift {

nlohmann::json::json_pointer pointer_of_path(const std::string& path) {
  std::string pointer;
  for (const char c : path) {
    if (c == '[' || c == '.') {
      pointer += '/';
    } else if (c != ']') {
      pointer += c;
    }
  }
  return nlohmann::json::json_pointer(pointer.empty() ? "" : "/" + pointer);
}

nlohmann::json* node_at(nlohmann::json& document, const std::string& path) {
  return const_cast<nlohmann::json*>(node_at(static_cast<const nlohmann::json&>(document), path));
}

const nlohmann::json* node_at(const nlohmann::json& document, const std::string& path) {
  const auto pointer = pointer_of_path(path);
  try {
    return document.contains(pointer) ? &document.at(pointer) : nullptr;
  } catch (const nlohmann::json::exception&) {  // an index where there is no list
    return nullptr;
  }
}

}  // namespace zerodrift
