#include "bad_cable.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <vector>

namespace zerodrift::controller {
namespace {

constexpr long alone = 24;  // bytes: an envelope and a good part of what is in it

sockaddr_in local(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  return address;
}

void quick(int handle) {
  const int on = 1;
  ::setsockopt(handle, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

}  // namespace

BadCable::BadCable(int device_port) : m_device_port(device_port), m_listener(::socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address = local(0);
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (::bind(m_listener, generic, size) == 0 && ::listen(m_listener, 4) == 0 &&
      ::getsockname(m_listener, generic, &size) == 0) {
    m_port = ntohs(address.sin_port);
  }
  m_thread = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

BadCable::~BadCable() {
  m_thread.request_stop();
  m_thread.join();
  ::close(m_listener);
}

void BadCable::strike(Fault fault, long n) {
  m_fault = fault;
  m_passed = 0;
  m_strike_at = n;
}

void BadCable::serve(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd wait{m_listener, POLLIN, 0};
    if (::poll(&wait, 1, 20) <= 0) continue;
    const int host = ::accept(m_listener, nullptr, nullptr);
    quick(host);
    relay(host, stop);
    ::close(host);
  }
}

void BadCable::relay(int host, const std::stop_token& stop) {
  const int device = ::socket(AF_INET, SOCK_STREAM, 0);
  const sockaddr_in address = local(m_device_port);
  m_stalled = false;
  bool good = ::connect(device, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  quick(device);
  while (good && !stop.stop_requested()) {
    std::array<pollfd, 2> wait{pollfd{host, POLLIN, 0}, pollfd{device, POLLIN, 0}};
    if (::poll(wait.data(), 2, 20) <= 0) continue;
    if (wait[0].revents != 0) good = pass(host, device);
    if (good && wait[1].revents != 0) good = pass(device, host);
  }
  ::close(device);
}

bool BadCable::pass(int from, int to) {
  std::array<std::uint8_t, 1024> buffer{};
  const auto got = ::recv(from, buffer.data(), buffer.size(), 0);
  if (got <= 0) return false;
  std::vector<std::uint8_t> bytes;
  bool cut = false;
  for (long i = 0; i < got && !cut; ++i) {
    std::uint8_t byte = buffer[static_cast<std::size_t>(i)];
    const bool hit = m_passed++ == m_strike_at;
    if (hit && m_fault == Fault::stall) m_stalled = true;
    if (hit && m_fault == Fault::delay) {  // the bytes before it were on their way already
      if (!bytes.empty() && ::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) return false;
      bytes.clear();
      std::this_thread::sleep_for(m_delay);
    }
    if (hit && m_fault == Fault::corrupt) byte ^= 0x5A;
    if (m_stalled || (hit && m_fault == Fault::drop)) continue;
    cut = hit && m_fault == Fault::cut;
    if (!cut) bytes.push_back(byte);
    if (hit && m_fault == Fault::duplicate) bytes.push_back(byte);
    if (m_passed - 2 == m_strike_at && m_fault == Fault::reorder && bytes.size() > 1) {
      std::swap(bytes[bytes.size() - 1], bytes[bytes.size() - 2]);
    }
    if (m_fault == Fault::split && m_strike_at >= 0 && m_passed > m_strike_at && m_passed <= m_strike_at + alone) {
      if (!bytes.empty() && ::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) return false;
      bytes.clear();
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }
  if (!bytes.empty() && ::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL) < 0) return false;
  return !cut;
}

}  // namespace zerodrift::controller
