#include "core/base/resources.h"

#include <string>
#include <system_error>

namespace zerodrift {

Result<std::filesystem::path> find_resource(std::string_view name) {
  namespace fs = std::filesystem;
  std::error_code ignored;
  fs::path folder = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  // Programs stand in bin/ (installed), build/<preset>/bin/ (built); six levels cover both and no more of the disk.
  for (int level = 0; level < 6 && !folder.empty(); ++level) {
    for (const char* below : {"resources", "share/zerodrift/resources"}) {
      const fs::path candidate = folder / below / name;
      if (fs::exists(candidate, ignored)) return candidate;
    }
    if (folder == folder.root_path()) break;
    folder = folder.parent_path();
  }
  return fail(ErrorCode::file_not_found, {{"file", "resources/" + std::string(name)}});
}

}  // namespace zerodrift
