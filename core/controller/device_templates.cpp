#include "core/controller/device_templates.h"

#include <algorithm>
#include <filesystem>

#include "core/base/json.h"
#include "core/base/resources.h"

namespace zerodrift::controller {
namespace {

/// Names of the JSON files of a folder of resources, which holds `one` in any case.
std::vector<std::string> names_in(const std::string& folder, const std::string& one) {
  std::vector<std::string> names;
  const auto known = find_resource(folder + "/" + one + ".json");
  if (!known) return names;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(known->parent_path(), none)) {
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

std::vector<DeviceTemplate> device_templates() {
  std::vector<DeviceTemplate> templates;
  for (const std::string& name : names_in("devices", "probe-amplifier")) {
    const auto path = find_resource("devices/" + name + ".json");
    if (!path) continue;
    auto entry = read_json_file(*path);
    if (entry && entry->is_object()) templates.push_back({name, std::move(*entry)});
  }
  return templates;
}

std::vector<std::string> shipped_register_maps() {
  return names_in("register_maps", "probe-amplifier");
}

}  // namespace zerodrift::controller
