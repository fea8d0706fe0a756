#include "core/base/write_failure.h"

#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <system_error>

namespace zerodrift {
namespace {

/// Empty when the folder is none.
std::string obstacle_of(const std::filesystem::path& folder) {
  std::error_code ignored;
  if (!std::filesystem::exists(folder, ignored)) return "there is no folder " + folder.string();
  if (!std::filesystem::is_directory(folder, ignored)) return folder.string() + " is no folder";
  if (::access(folder.c_str(), W_OK) != 0) return "nothing may be written into the folder " + folder.string();
  return {};
}

}  // namespace

Error write_failure(const std::filesystem::path& path, int error_number) {
  if (error_number == ENOSPC || error_number == EDQUOT) return {ErrorCode::disk_full, {{"file", path.string()}}};
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const std::string obstacle = obstacle_of(folder);
  return {ErrorCode::file_not_writable,
          {{"file", path.string()}, {"detail", obstacle.empty() ? std::strerror(error_number) : obstacle}}};
}

}  // namespace zerodrift
