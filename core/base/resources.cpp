#include "core/base/resources.h"

#include <cstdlib>
#include <string>
#include <system_error>

namespace zerodrift {
namespace {

namespace fs = std::filesystem;

std::string& called_as() {
  static std::string name;
  return name;
}

}  // namespace

void set_program_name(const char* name) {
  called_as() = name == nullptr ? "" : name;
}

fs::path program_path(const std::string& name) {
  std::error_code ignored;
  if (name.empty()) return {};
  if (name.find('/') != std::string::npos) return fs::weakly_canonical(fs::absolute(name, ignored), ignored);
  const char* variable = std::getenv("PATH");
  std::string rest = variable == nullptr ? "" : variable;
  while (!rest.empty()) {
    const auto colon = rest.find(':');
    const fs::path candidate = fs::path(rest.substr(0, colon)) / name;
    if (fs::exists(candidate, ignored)) return fs::weakly_canonical(candidate, ignored);
    rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
  }
  return {};
}

fs::path find_resource_beside(const fs::path& program, std::string_view name) {
  std::error_code ignored;
  fs::path folder = program.parent_path();
  // Programs stand in bin/ (installed), build/<preset>/bin/ (built); six levels cover both and no more of the disk.
  for (int level = 0; level < 6 && !folder.empty(); ++level) {
    for (const char* below : {"resources", "share/zerodrift/resources"}) {
      fs::path candidate = folder / below / name;
      if (fs::exists(candidate, ignored)) return candidate;
    }
    if (folder == folder.root_path()) break;
    folder = folder.parent_path();
  }
  return {};
}

Result<fs::path> find_resource(std::string_view name) {
  std::error_code ignored;
  if (const char* given = std::getenv("ZERODRIFT_RESOURCES"); given != nullptr && *given != '\0') {
    const fs::path candidate = fs::path(given) / name;
    if (fs::exists(candidate, ignored)) return candidate;
  }
  for (const fs::path& program : {fs::read_symlink("/proc/self/exe", ignored), program_path(called_as())}) {
    const fs::path found = find_resource_beside(program, name);
    if (!found.empty()) return found;
  }
  return fail(ErrorCode::file_not_found, {{"file", "resources/" + std::string(name)}});
}

}  // namespace zerodrift
