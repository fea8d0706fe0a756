#include "core/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

namespace zerodrift {
namespace {

tl::unexpected<Error> write_failure(const std::filesystem::path& path, int error_number) {
  if (error_number == ENOSPC || error_number == EDQUOT) return fail(ErrorCode::disk_full, {{"file", path.string()}});
  return fail(ErrorCode::file_not_writable, {{"file", path.string()}, {"detail", std::strerror(error_number)}});
}

/// Writes everything and flushes it to the disk; 0 or errno.
int write_all(int descriptor, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      return errno;
    }
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  // Devices such as /dev/stdout cannot be synchronised; that is no failure of the write.
  if (::fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP && errno != EROFS) return errno;
  return 0;
}

Status write_in_place(const std::filesystem::path& path, std::string_view bytes) {
  const int descriptor = ::open(path.c_str(), O_WRONLY);
  if (descriptor < 0) return write_failure(path, errno);
  const int error_number = write_all(descriptor, bytes);
  ::close(descriptor);
  if (error_number != 0) return write_failure(path, error_number);
  return {};
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path, std::size_t limit_bytes) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return fail(ErrorCode::file_not_found, {{"file", path.string()}});
  if (std::filesystem::is_directory(path, ignored)) {
    return fail(ErrorCode::file_unreadable, {{"file", path.string()}, {"detail", "is a folder"}});
  }
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return fail(ErrorCode::file_unreadable, {{"file", path.string()}, {"detail", std::strerror(errno)}});
  std::string bytes;
  std::string block(std::size_t{1} << 16, '\0');
  while (stream.read(block.data(), static_cast<std::streamsize>(block.size())) || stream.gcount() > 0) {
    bytes.append(block.data(), static_cast<std::size_t>(stream.gcount()));
    if (bytes.size() > limit_bytes) {
      return fail(ErrorCode::file_too_large, {{"file", path.string()},
                                              {"size", "more than " + std::to_string(limit_bytes)},
                                              {"limit", std::to_string(limit_bytes)}});
    }
  }
  if (stream.bad())
    return fail(ErrorCode::file_unreadable, {{"file", path.string()}, {"detail", std::strerror(errno)}});
  return bytes;
}

Status write_file(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  if (kind == std::filesystem::file_type::character || kind == std::filesystem::file_type::fifo) {
    return write_in_place(path, bytes);
  }
  std::string temporary = path.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(temporary.data());
  if (descriptor < 0) return write_failure(path, errno);
  int error_number = write_all(descriptor, bytes);
  if (error_number == 0 && ::fchmod(descriptor, 0644) != 0) error_number = errno;
  ::close(descriptor);
  if (error_number == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error_number = errno;
  if (error_number == 0) return {};
  ::unlink(temporary.c_str());
  return write_failure(path, error_number);
}

Status append_file(const std::filesystem::path& path, std::string_view lines) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) return write_failure(path, errno);
  std::string bytes;
  char last = '\n';
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  if (size > 0 && ::pread(descriptor, &last, 1, size - 1) == 1 && last != '\n') bytes += '\n';
  bytes += lines;
  const int error_number = write_all(descriptor, bytes);
  ::close(descriptor);
  if (error_number != 0) return write_failure(path, error_number);
  return {};
}

}  // namespace zerodrift
