#include "serial_device.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <cstdlib>

#include "core/controller/rtu_reply.h"

namespace zerodrift::controller {
namespace {

int serial_word(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] << 8 | bytes[at + 1];
}

}  // namespace

SerialDevice::SerialDevice(SerialHabits habits) : m_habits(std::move(habits)) {
  m_master = ::posix_openpt(O_RDWR | O_NOCTTY);
  if (m_master < 0 || ::grantpt(m_master) != 0 || ::unlockpt(m_master) != 0) {
    ADD_FAILURE() << "no pseudo-terminal";
    return;
  }
  m_port = ::ptsname(m_master);
  m_slave = ::open(m_port.c_str(), O_RDWR | O_NOCTTY);
  termios raw{};
  ::tcgetattr(m_slave, &raw);
  ::cfmakeraw(&raw);
  ::tcsetattr(m_slave, TCSANOW, &raw);
  m_thread = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

SerialDevice::~SerialDevice() {
  m_thread.request_stop();
  if (m_thread.joinable()) m_thread.join();
  if (m_slave >= 0) ::close(m_slave);
  if (m_master >= 0) ::close(m_master);
}

ControllerSettings SerialDevice::settings() const {
  ControllerSettings settings;
  settings.kind = LinkKind::rtu;
  settings.device = m_port;
  settings.baud = 115200;
  settings.parity = 'N';
  settings.timeout_ms = 200;
  return settings;
}

std::uint16_t SerialDevice::word(int address) const {
  const std::scoped_lock guard(m_lock);
  return m_words.at(static_cast<std::size_t>(address));
}

void SerialDevice::set(int address, std::uint16_t value) {
  const std::scoped_lock guard(m_lock);
  m_words.at(static_cast<std::size_t>(address)) = value;
}

std::vector<int> SerialDevice::functions() const {
  const std::scoped_lock guard(m_lock);
  return m_functions;
}

void SerialDevice::serve(const std::stop_token& stop) {
  std::vector<std::uint8_t> bytes;
  std::array<std::uint8_t, 512> buffer;
  while (!stop.stop_requested()) {
    pollfd wait{m_master, POLLIN, 0};
    if (::poll(&wait, 1, 20) <= 0) continue;
    const auto got = ::read(m_master, buffer.data(), buffer.size());
    if (got <= 0) continue;
    bytes.insert(bytes.end(), buffer.begin(), buffer.begin() + got);
    while (answer(bytes)) {
    }
  }
}

bool SerialDevice::answer(std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < 8) return false;
  const std::size_t size = bytes[1] == 16 ? 9U + bytes[6] : 8U;
  if (bytes.size() < size) return false;
  const std::vector<std::uint8_t> request(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  bytes.erase(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  if (m_habits.echo) send(request);
  int number = 0;
  {
    const std::scoped_lock guard(m_lock);
    number = static_cast<int>(m_functions.size());
    m_functions.push_back(request[1]);
  }
  std::vector<std::uint8_t> reply = reply_to(std::span(request).first(size - 2));
  append_rtu_crc(reply);
  if (m_habits.delay) std::this_thread::sleep_for(m_habits.delay(number));
  const std::vector<std::uint8_t> zeros(8, 0);
  send(std::span(zeros).first(static_cast<std::size_t>(m_habits.zeros_before)));
  // In two parts, as it comes from a slow line.
  send(std::span(reply).first(3));
  std::this_thread::sleep_for(std::chrono::milliseconds(2));
  send(std::span(reply).subspan(3));
  send(std::span(zeros).first(static_cast<std::size_t>(m_habits.zeros_after)));
  return true;
}

std::vector<std::uint8_t> SerialDevice::reply_to(std::span<const std::uint8_t> request) {
  const int function = request[1];
  const auto unit = static_cast<std::uint8_t>(m_habits.unit);
  const auto exception = [&](std::uint8_t code) {
    return std::vector<std::uint8_t>{unit, static_cast<std::uint8_t>(function | 0x80), code};
  };
  if (m_habits.without_functions.contains(function)) return exception(1);
  const std::scoped_lock guard(m_lock);
  const int address = serial_word(request, 2);
  const int value = serial_word(request, 4);
  std::vector<std::uint8_t> reply{unit, request[1]};
  if (function == 3) {
    if (address + value > static_cast<int>(m_words.size())) return exception(2);
    reply.push_back(static_cast<std::uint8_t>(2 * value));
    for (int i = 0; i < value; ++i) {
      const std::uint16_t word = m_words.at(static_cast<std::size_t>(address + i));
      reply.push_back(static_cast<std::uint8_t>(word >> 8));
      reply.push_back(static_cast<std::uint8_t>(word & 0xFF));
    }
    return reply;
  }
  if (function == 6) m_words.at(static_cast<std::size_t>(address)) = static_cast<std::uint16_t>(value);
  for (int i = 0; function == 16 && i < value; ++i) {
    m_words.at(static_cast<std::size_t>(address + i)) =
        static_cast<std::uint16_t>(serial_word(request, 7 + 2 * static_cast<std::size_t>(i)));
  }
  reply.insert(reply.end(), request.begin() + 2, request.begin() + 6);
  return reply;
}

void SerialDevice::send(std::span<const std::uint8_t> bytes) const {
  if (bytes.empty()) return;
  [[maybe_unused]] const auto written = ::write(m_master, bytes.data(), bytes.size());
}

}  // namespace zerodrift::controller
