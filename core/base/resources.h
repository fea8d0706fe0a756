#pragma once
// Files shipped with the program (register maps, presets), found at run time: in the folder that the environment
// variable ZERODRIFT_RESOURCES names, else beside the program (../resources), where an installation puts them
// (../share/zerodrift/resources), or in the source tree the program was built in.

#include <filesystem>
#include <string>
#include <string_view>

#include "core/base/result.h"

namespace zerodrift {

/// What the program was called as (argv[0]): where it stands, should the system not tell (no /proc in a container).
void set_program_name(const char* name);
/// The path of a shipped file by its name below resources/, for example "register_maps/zerodrift-virtual.json".
Result<std::filesystem::path> find_resource(std::string_view name);
/// The same for a program at this path, without the environment; empty when there is no such file.
std::filesystem::path find_resource_beside(const std::filesystem::path& program, std::string_view name);
/// The full path of a program called by this name: as it is, relative to the working folder, or by PATH.
std::filesystem::path program_path(const std::string& name);

}  // namespace zerodrift
