#include "core/controller/find_devices.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <set>

#include "core/base/clock.h"
#include "core/controller/link.h"

namespace zerodrift::controller {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_networks = 4;
constexpr std::uint32_t neighbours = 0xFFFFFF00;  // of a larger network only the /24 around the own address
constexpr std::size_t at_once = 64;               // connections
constexpr int listen_patience_ms = 400;           // a local network answers in a few ms

std::vector<fs::path> entries_of(const fs::path& folder) {
  std::vector<fs::path> entries;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder, none)) entries.push_back(entry.path());
  std::sort(entries.begin(), entries.end());
  return entries;
}

/// One attempt to connect that does not wait.
struct Attempt {
  int socket = -1;
  const HostPort* address = nullptr;
  bool open = false;
};

Attempt begin(const HostPort& address) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(address.port));
  if (::inet_pton(AF_INET, address.host.c_str(), &to.sin_addr) != 1) return {};
  const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
  if (socket < 0) return {};
  const int done = ::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to);
  if (done == 0) return {socket, &address, true};
  if (errno == EINPROGRESS) return {socket, &address, false};
  ::close(socket);
  return {};
}

bool is_open(int socket) {
  int fault = 0;
  socklen_t size = sizeof fault;
  return ::getsockopt(socket, SOL_SOCKET, SO_ERROR, &fault, &size) == 0 && fault == 0;
}

/// Waits for all of them, at most the patience.
void settle(std::vector<Attempt>& attempts, const std::stop_token& stop) {
  const Seconds end = host_clock().steady() + Seconds(listen_patience_ms / 1000.0);
  std::set<std::size_t> waiting;
  for (std::size_t i = 0; i < attempts.size(); ++i) {
    if (attempts[i].socket >= 0 && !attempts[i].open) waiting.insert(i);
  }
  while (!waiting.empty() && host_clock().steady() < end && !stop.stop_requested()) {
    std::vector<pollfd> polled;
    for (const std::size_t i : waiting) polled.push_back({attempts[i].socket, POLLOUT, 0});
    constexpr int look_ms = 50;
    if (::poll(polled.data(), polled.size(), look_ms) < 0) break;
    std::size_t next = 0;
    for (auto at = waiting.begin(); at != waiting.end(); ++next) {
      if (polled[next].revents == 0) {
        ++at;
        continue;
      }
      attempts[*at].open = is_open(attempts[*at].socket);
      at = waiting.erase(at);
    }
  }
}

}  // namespace

std::vector<SerialPort> serial_ports(const fs::path& folder) {
  std::vector<SerialPort> ports;
  std::set<fs::path> named;
  std::error_code none;
  for (const fs::path& link : entries_of(folder / "serial" / "by-id")) {
    const fs::path device = fs::canonical(link, none);
    if (none) continue;
    named.insert(device);
    ports.push_back({link.string(), device.string()});
  }
  for (const fs::path& entry : entries_of(folder)) {
    const std::string name = entry.filename().string();
    const bool adapter = name.starts_with("ttyUSB") || name.starts_with("ttyACM") || name.starts_with("ttyAMA");
    // The kernel lists sockets of serial ports without a chip, too; those have no driver of a device.
    const bool chip = name.starts_with("ttyS") && fs::exists("/sys/class/tty/" + name + "/device/driver", none) &&
                      fs::canonical("/sys/class/tty/" + name + "/device/driver", none).filename() != "serial8250";
    if ((adapter || chip) && !named.contains(fs::canonical(entry, none))) {
      ports.push_back({entry.string(), entry.string()});
    }
  }
  return ports;
}

Status find_units(ControllerSettings line, int first, int last, const TaskContext& context,
                  const std::function<void(const FoundUnit&)>& found) {
  for (int unit = first; unit <= last; ++unit) {
    if (context.cancelled()) return fail(ErrorCode::cancelled);
    context.progress(static_cast<double>(unit - first) / (last - first + 1), "unit " + std::to_string(unit));
    line.unit = unit;
    Link link(line);
    link.set_attempts(1);
    const Seconds begun = host_clock().steady();
    const auto answer = link.read(RegisterSpace::holding, 0, 1, "unit " + std::to_string(unit));
    const Seconds took = host_clock().steady() - begun;
    if (answer) {
      found({unit, took.count()});
      continue;
    }
    switch (answer.error().code) {
      case ErrorCode::machine_exception:
      case ErrorCode::machine_function_missing:
      case ErrorCode::machine_busy:
      case ErrorCode::machine_failed:
        found({unit, took.count()});
        break;
      case ErrorCode::machine_unreachable:
        return fail(answer.error());  // no other unit is there either
      default:
        break;
    }
  }
  return {};
}

std::vector<HostPort> own_network() {
  std::vector<HostPort> addresses;
  ifaddrs* all = nullptr;
  if (::getifaddrs(&all) != 0) return addresses;
  std::set<std::uint32_t> networks;
  for (const ifaddrs* one = all; one != nullptr; one = one->ifa_next) {
    if (one->ifa_addr == nullptr || one->ifa_netmask == nullptr || one->ifa_addr->sa_family != AF_INET) continue;
    if ((one->ifa_flags & IFF_LOOPBACK) != 0 || (one->ifa_flags & IFF_UP) == 0) continue;
    sockaddr_in own{};
    sockaddr_in mask{};
    std::memcpy(&own, one->ifa_addr, sizeof own);
    std::memcpy(&mask, one->ifa_netmask, sizeof mask);
    const std::uint32_t address = ntohl(own.sin_addr.s_addr);
    const std::uint32_t bits = ntohl(mask.sin_addr.s_addr) | neighbours;
    const std::uint32_t network = address & bits;
    if (networks.size() == most_networks || !networks.insert(network).second) continue;
    for (std::uint32_t host = network + 1; host < (network | ~bits); ++host) {
      if (host == address) continue;
      const in_addr raw{htonl(host)};
      char text[INET_ADDRSTRLEN] = {};
      ::inet_ntop(AF_INET, &raw, text, sizeof text);
      for (const int port : {modbus_port, agent_port}) addresses.push_back({text, port});
    }
  }
  ::freeifaddrs(all);
  return addresses;
}

Status find_listeners(const std::vector<HostPort>& addresses, const TaskContext& context,
                      const std::function<void(const HostPort&)>& found) {
  for (std::size_t from = 0; from < addresses.size(); from += at_once) {
    if (context.cancelled()) return fail(ErrorCode::cancelled);
    context.progress(static_cast<double>(from) / static_cast<double>(addresses.size()), addresses[from].host);
    std::vector<Attempt> attempts;
    const std::size_t end = std::min(addresses.size(), from + at_once);
    for (std::size_t i = from; i < end; ++i) attempts.push_back(begin(addresses[i]));
    settle(attempts, context.stop);
    for (const Attempt& attempt : attempts) {
      if (attempt.socket < 0) continue;
      ::close(attempt.socket);
      if (attempt.open) found(*attempt.address);
    }
  }
  return {};
}

}  // namespace zerodrift::controller
