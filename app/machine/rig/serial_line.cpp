#include "app/machine/rig/serial_line.h"

#include <fcntl.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace zerodrift::machine {
namespace {

constexpr int silence_ms = 4;  // 3.5 characters at 19200 baud are 2 ms; the scheduler may take as long again
constexpr int idle_turn_ms = 100;
constexpr std::size_t longest_frame = 256;

tl::unexpected<Error> no_terminal() {
  return fail(ErrorCode::file_not_writable, {{"file", "/dev/ptmx"}, {"detail", std::strerror(errno)}});
}

}  // namespace

Result<std::unique_ptr<SerialLine>> SerialLine::open(RtuUnits units) {
  std::unique_ptr<SerialLine> line(new SerialLine(std::move(units)));
  ZD_CHECK(line->open_ends());
  line->m_thread = std::jthread([&own = *line](const std::stop_token& stop) { own.serve(stop); });
  return line;
}

Status SerialLine::open_ends() {
  m_own_end = ::posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC | O_NONBLOCK);
  if (m_own_end < 0 || ::grantpt(m_own_end) != 0 || ::unlockpt(m_own_end) != 0) return no_terminal();
  std::array<char, 64> name{};
  if (::ptsname_r(m_own_end, name.data(), name.size()) != 0) return no_terminal();
  m_path = name.data();
  m_other_end = ::open(m_path.c_str(), O_RDWR | O_NOCTTY | O_CLOEXEC);
  termios settings{};
  if (m_other_end < 0 || ::tcgetattr(m_other_end, &settings) != 0) return no_terminal();
  ::cfmakeraw(&settings);
  ::cfsetspeed(&settings, B19200);
  if (::tcsetattr(m_other_end, TCSANOW, &settings) != 0) return no_terminal();
  return {};
}

SerialLine::~SerialLine() {
  m_thread.request_stop();
  if (m_thread.joinable()) m_thread.join();
  if (m_own_end >= 0) ::close(m_own_end);
  if (m_other_end >= 0) ::close(m_other_end);
}

void SerialLine::serve(const std::stop_token& stop) const {
  std::vector<std::uint8_t> frame;
  while (!stop.stop_requested()) {
    pollfd wait{m_own_end, POLLIN, 0};
    const int ready = ::poll(&wait, 1, frame.empty() ? idle_turn_ms : silence_ms);
    if (ready < 0 && errno != EINTR) return;
    if (ready > 0) {
      std::array<std::uint8_t, longest_frame> bytes{};
      const auto got = ::read(m_own_end, bytes.data(), bytes.size());
      if (got > 0) frame.insert(frame.end(), bytes.begin(), bytes.begin() + got);
      continue;
    }
    if (ready == 0 && !frame.empty()) {
      const auto reply = m_units.answer(frame);
      // What does not fit is lost, as on a line where nobody listens.
      if (!reply.empty()) static_cast<void>(!::write(m_own_end, reply.data(), reply.size()));
      frame.clear();
    }
  }
}

}  // namespace zerodrift::machine
