#include "core/commissioning/lock_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>

#include "core/base/write_failure.h"

namespace zerodrift::commissioning {
namespace {

// The former holder removes the file: a lock on a removed file protects nothing.
bool still_named(int handle, const std::filesystem::path& path) {
  struct stat held {};
  struct stat named {};
  return fstat(handle, &held) == 0 && stat(path.c_str(), &named) == 0 && held.st_ino == named.st_ino &&
         held.st_dev == named.st_dev;
}

}  // namespace

Result<std::unique_ptr<LockFile>> LockFile::take(const std::filesystem::path& job) {
  const std::filesystem::path path = job.string() + "-lock";
  for (;;) {
    const int handle = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (handle < 0) {
      return fail(write_failure(job, errno));
    }
    if (::flock(handle, LOCK_EX | LOCK_NB) != 0) {
      ::close(handle);
      return fail(ErrorCode::job_busy, {{"file", job.string()}});
    }
    if (still_named(handle, path)) return std::unique_ptr<LockFile>(new LockFile(path, handle));
    ::close(handle);
  }
}

LockFile::~LockFile() {
  ::unlink(m_path.c_str());
  ::close(m_handle);
}

}  // namespace zerodrift::commissioning
