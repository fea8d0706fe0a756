#pragma once
// One writer a job: a lock on "<job>-lock" that the system drops with the process, however it ends. A file of its own,
// because closing any second handle of a database file would drop the database's locks with it (POSIX fcntl).

#include <filesystem>
#include <memory>

#include "core/base/result.h"

namespace zerodrift::commissioning {

class LockFile {
 public:
  /// job_busy (naming the job) when someone holds it.
  static Result<std::unique_ptr<LockFile>> take(const std::filesystem::path& job);
  ~LockFile();
  LockFile(const LockFile&) = delete;
  LockFile& operator=(const LockFile&) = delete;

 private:
  LockFile(std::filesystem::path path, int handle) : m_path(std::move(path)), m_handle(handle) {}
  std::filesystem::path m_path;
  int m_handle;
};

}  // namespace zerodrift::commissioning
