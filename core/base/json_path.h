#pragma once
// Places in a document by the names that errors use: "devices[1].unit".

#include <nlohmann/json.hpp>
#include <string>

namespace zerodrift {

/// Of "devices[1].unit" the pointer "/devices/1/unit"; of an empty path the whole document.
nlohmann::json::json_pointer pointer_of_path(const std::string& path);
/// What is there; null when there is nothing.
nlohmann::json* node_at(nlohmann::json& document, const std::string& path);
const nlohmann::json* node_at(const nlohmann::json& document, const std::string& path);

}  // namespace zerodrift
