#pragma once
// Files shipped with the program (register maps, presets), found at run time: beside the program (../resources), where
// an installation puts them (../share/zerodrift/resources), or in the source tree the program was built in.

#include <filesystem>
#include <string_view>

#include "core/base/result.h"

namespace zerodrift {

/// The path of a shipped file by its name below resources/, for example "register_maps/zerodrift-virtual.json".
Result<std::filesystem::path> find_resource(std::string_view name);

}  // namespace zerodrift
