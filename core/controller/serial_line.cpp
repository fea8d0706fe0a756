#include "core/controller/serial_line.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <map>
#include <thread>

namespace zerodrift::controller {

std::shared_ptr<SerialLine> SerialLine::of(const std::string& port) {
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<SerialLine>> lines;
  std::error_code unresolved;
  const auto path = std::filesystem::canonical(port, unresolved);
  const std::string key = unresolved ? port : path.string();
  const std::lock_guard lock(mutex);
  std::shared_ptr<SerialLine> line = lines[key].lock();
  if (!line) lines[key] = line = std::make_shared<SerialLine>(key);
  return line;
}

SerialLine::~SerialLine() {
  if (m_claim >= 0) ::close(m_claim);
}

SerialLine::Turn::Turn(SerialLine& line) : m_line(line) {
  std::unique_lock lock(m_line.m_mutex);
  const std::uint64_t ticket = m_line.m_drawn++;
  m_line.m_next.wait(lock, [&] { return m_line.m_serving == ticket; });
}

SerialLine::Turn::~Turn() {
  {
    const std::lock_guard lock(m_line.m_mutex);
    ++m_line.m_serving;
  }
  m_line.m_next.notify_all();
}

std::size_t SerialLine::waiting() {
  const std::lock_guard lock(m_mutex);
  const std::uint64_t with_the_one_served = m_drawn - m_serving;
  return with_the_one_served == 0 ? 0 : static_cast<std::size_t>(with_the_one_served - 1);
}

Status SerialLine::claim() {
  const auto unreachable = [this](const char* detail) {
    return fail(ErrorCode::machine_unreachable, {{"host", m_port}, {"port", "serial"}, {"detail", detail}});
  };
  // Anew each time: an adapter that was plugged in again is another device under the same name.
  if (m_claim >= 0) ::close(m_claim);
  m_claim = ::open(m_port.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (m_claim < 0) return unreachable(errno == EBUSY ? "another program has the serial port" : std::strerror(errno));
  if (::flock(m_claim, LOCK_EX | LOCK_NB) == 0) return {};
  ::close(m_claim);
  m_claim = -1;
  return unreachable("another program has the serial port");
}

void SerialLine::leave_in_peace(std::chrono::milliseconds duration) {
  m_in_peace_until = std::chrono::steady_clock::now() + duration;
}

void SerialLine::wait_for_peace() const {
  std::this_thread::sleep_until(m_in_peace_until);
}

}  // namespace zerodrift::controller
