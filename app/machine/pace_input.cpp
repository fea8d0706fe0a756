#include "app/machine/pace_input.h"

#include <poll.h>
#include <unistd.h>

#include <array>
#include <charconv>

namespace zerodrift::machine {

std::optional<int> PaceInput::wait(std::chrono::milliseconds time, int fastest) {
  pollfd input{m_file, POLLIN, 0};  // a negative file only waits
  if (::poll(&input, 1, static_cast<int>(time.count())) <= 0) return std::nullopt;
  std::array<char, 64> bytes{};
  const auto count = ::read(m_file, bytes.data(), bytes.size());
  if (count <= 0) {
    m_file = -1;
    return std::nullopt;
  }
  std::optional<int> named;
  for (const char byte : std::string(bytes.data(), static_cast<std::size_t>(count))) {
    if (byte != '\n') {
      m_begun += byte;
      continue;
    }
    int pace = 0;
    const auto read = std::from_chars(m_begun.data(), m_begun.data() + m_begun.size(), pace);
    if (read.ec == std::errc() && pace >= 1 && pace <= fastest) named = pace;
    m_begun.clear();
  }
  return named;
}

}  // namespace zerodrift::machine
