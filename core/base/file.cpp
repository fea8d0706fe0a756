#include "core/base/file.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/base/write_failure.h"

namespace zerodrift {
namespace {

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
  if (descriptor < 0) return fail(write_failure(path, errno));
  const int error_number = write_all(descriptor, bytes);
  ::close(descriptor);
  if (error_number != 0) return fail(write_failure(path, error_number));
  return {};
}

tl::unexpected<Error> unreadable(const std::filesystem::path& path, const std::string& detail) {
  return fail(ErrorCode::file_unreadable, {{"file", path.string()}, {"detail", detail}});
}

struct Descriptor {
  explicit Descriptor(int of_file) : number(of_file) {}
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number;
};

std::atomic<bool> reads_ended{false};

/// Until a pipe, a terminal or a device has bytes, or has come to its end.
Status wait_for_bytes(int descriptor) {
  constexpr int look_again_ms = 50;
  pollfd waiting{descriptor, POLLIN, 0};
  do {
    if (reads_ended) return fail(ErrorCode::cancelled);
  } while (::poll(&waiting, 1, look_again_ms) <= 0);
  return {};
}

}  // namespace

Result<std::string> read_file(const std::filesystem::path& path, std::size_t limit_bytes) {
  std::error_code ignored;
  if (!std::filesystem::exists(path, ignored)) return fail(ErrorCode::file_not_found, {{"file", path.string()}});
  if (std::filesystem::is_directory(path, ignored)) return unreadable(path, "is a folder");
  // A pipe without a writer is opened at once this way, and waited for below.
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)};
  if (file.number < 0) return unreadable(path, std::strerror(errno));
  const bool may_wait = !std::filesystem::is_regular_file(path, ignored);
  std::string bytes;
  std::string block(std::size_t{1} << 16, '\0');
  for (;;) {
    if (may_wait) ZD_CHECK(wait_for_bytes(file.number));
    const ssize_t count = ::read(file.number, block.data(), block.size());
    if (count < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (count < 0) return unreadable(path, std::strerror(errno));
    if (count == 0) return bytes;
    bytes.append(block.data(), static_cast<std::size_t>(count));
    if (bytes.size() > limit_bytes) {
      return fail(ErrorCode::file_too_large, {{"file", path.string()},
                                              {"size", "more than " + std::to_string(limit_bytes)},
                                              {"limit", std::to_string(limit_bytes)}});
    }
  }
}

void end_waiting_reads() {
  reads_ended = true;
}

Status write_file(const std::filesystem::path& path, std::string_view bytes) {
  std::error_code ignored;
  const auto kind = std::filesystem::status(path, ignored).type();
  if (kind == std::filesystem::file_type::character || kind == std::filesystem::file_type::fifo) {
    return write_in_place(path, bytes);
  }
  std::string temporary = path.string() + ".XXXXXX";
  const int descriptor = ::mkstemp(temporary.data());
  if (descriptor < 0) return fail(write_failure(path, errno));
  int error_number = write_all(descriptor, bytes);
  if (error_number == 0 && ::fchmod(descriptor, 0644) != 0) error_number = errno;
  ::close(descriptor);
  if (error_number == 0 && ::rename(temporary.c_str(), path.c_str()) != 0) error_number = errno;
  if (error_number == 0) return {};
  ::unlink(temporary.c_str());
  return fail(write_failure(path, error_number));
}

Status append_file(const std::filesystem::path& path, std::string_view lines) {
  const int descriptor = ::open(path.c_str(), O_RDWR | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
  if (descriptor < 0) return fail(write_failure(path, errno));
  std::string bytes;
  char last = '\n';
  const off_t size = ::lseek(descriptor, 0, SEEK_END);
  if (size > 0 && ::pread(descriptor, &last, 1, size - 1) == 1 && last != '\n') bytes += '\n';
  bytes += lines;
  const int error_number = write_all(descriptor, bytes);
  ::close(descriptor);
  if (error_number != 0) return fail(write_failure(path, error_number));
  return {};
}

}  // namespace zerodrift
