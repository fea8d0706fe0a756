#pragma once
// The names registers go by, and what each is for: what a map may name, what an editor offers.

#include <string_view>
#include <vector>

#include "core/controller/register_map.h"

namespace zerodrift::controller {

struct RegisterName {
  std::string_view name;
  std::string_view meaning;  // short, in English; the window translates it
  bool written = false;      // by us
};
const std::vector<RegisterName>& register_names();
/// Null for a name the program makes no use of.
const RegisterName* find_register_name(std::string_view name);

/// What a controller can be used for with this map, and what each use lacks.
struct MapUse {
  std::string_view use;  // "temperatures", "host offset", "table"
  std::vector<std::string> missing;
};
std::vector<MapUse> uses_of(const RegisterMap& map);

}  // namespace zerodrift::controller
