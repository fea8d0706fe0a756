#pragma once
// The devices that the program brings (resources/devices): a device entry of a profile without its address each, whose
// register map is the list of its registers.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace zerodrift::controller {

struct DeviceTemplate {
  std::string name;  // "temperature-module-8-pt100"
  nlohmann::json entry;
};

std::vector<DeviceTemplate> device_templates();
/// Names of the register maps that the program brings.
std::vector<std::string> shipped_register_maps();

}  // namespace zerodrift::controller
