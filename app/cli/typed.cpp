#include "app/cli/typed.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <utility>

namespace zerodrift::cli {
namespace {

constexpr int look_ms = 50;

std::atomic<bool> typing_ended{false};

/// Bytes that came with a line before. Several programs' lines may come at once down a pipe.
std::string& left_over() {
  static std::string bytes;
  return bytes;
}

std::optional<std::string> line_of(std::string& bytes) {
  const std::size_t end = bytes.find('\n');
  if (end == std::string::npos) return std::nullopt;
  std::string line = bytes.substr(0, end);
  bytes.erase(0, end + 1);
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return line;
}

}  // namespace

void end_typing() {
  typing_ended = true;
}

Result<std::optional<std::string>> typed_line() {
  std::string& bytes = left_over();
  for (;;) {
    if (typing_ended) return fail(ErrorCode::cancelled);
    if (auto line = line_of(bytes)) return line;
    pollfd input{STDIN_FILENO, POLLIN, 0};
    const int ready = ::poll(&input, 1, look_ms);
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    std::array<char, 4096> part;
    const auto got = ::read(STDIN_FILENO, part.data(), part.size());
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got > 0) {
      bytes.append(part.data(), static_cast<std::size_t>(got));
      continue;
    }
    if (bytes.empty()) return std::optional<std::string>();
    return std::optional<std::string>(std::exchange(bytes, {}));  // a last line without an end
  }
}

Result<std::optional<std::string>> typed_line(const std::string& question) {
  std::fprintf(stderr, "%s", question.c_str());
  std::fflush(stderr);
  return typed_line();
}

}  // namespace zerodrift::cli
