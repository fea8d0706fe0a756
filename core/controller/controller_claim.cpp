#include "core/controller/controller_claim.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <map>
#include <mutex>
#include <set>

namespace zerodrift::controller {
namespace {

constexpr int most_askers =
    4096;  // for the owner's number; nobody takes them in, the system cuts this to its own limit

/// Every numeric address of a host; its name where it has none, for the connection to tell what is wrong with it.
std::set<std::string> addresses_of(const std::string& host) {
  addrinfo hints{};
  hints.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  std::set<std::string> addresses;
  if (::getaddrinfo(host.c_str(), nullptr, &hints, &found) == 0) {
    for (const addrinfo* one = found; one != nullptr; one = one->ai_next) {
      std::array<char, NI_MAXHOST> text{};
      const int got =
          ::getnameinfo(one->ai_addr, one->ai_addrlen, text.data(), text.size(), nullptr, 0, NI_NUMERICHOST);
      if (got == 0) addresses.insert(text.data());
    }
    ::freeaddrinfo(found);
  }
  if (addresses.empty()) addresses.insert(host);
  return addresses;
}

/// The first byte of an abstract name is 0.
std::pair<sockaddr_un, socklen_t> named(const std::string& name) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::size_t size = std::min(name.size(), sizeof address.sun_path - 1);
  std::memcpy(address.sun_path + 1, name.data(), size);
  return {address, static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + size)};
}

int new_socket() {
  return ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
}

/// 0 when the system does not say.
int process_that_has(const std::string& name) {
  const int asker = new_socket();
  if (asker < 0) return 0;
  const auto [address, size] = named(name);
  ucred owner{};
  socklen_t owner_size = sizeof owner;
  const bool known = ::connect(asker, reinterpret_cast<const sockaddr*>(&address), size) == 0 &&
                     ::getsockopt(asker, SOL_SOCKET, SO_PEERCRED, &owner, &owner_size) == 0;
  ::close(asker);
  return known ? owner.pid : 0;
}

Error refused(const std::string& reason) {
  return Error{ErrorCode::machine_not_ready, {{"what", "a write from here"}, {"reason", reason}}};
}

Error taken_by(int process) {
  const std::string other =
      process == 0 ? std::string("another Zerodrift program works on this controller")
                   : fmt::format("another Zerodrift program, process {}, works on this controller", process);
  return refused(fmt::format("{}; {}", other, "end it or wait for it"));
}

Result<int> bound_to(const std::string& name) {
  const int claim = new_socket();
  if (claim < 0) return fail(refused(std::strerror(errno)));
  const auto [address, size] = named(name);
  if (::bind(claim, reinterpret_cast<const sockaddr*>(&address), size) == 0 && ::listen(claim, most_askers) == 0) {
    return claim;
  }
  const int why = errno;
  ::close(claim);
  return fail(why == EADDRINUSE ? taken_by(process_that_has(name)) : refused(std::strerror(why)));
}

/// The names that this program has, each with the number of those who share it.
class ClaimedNames {
 public:
  static ClaimedNames& of_this_program() {
    static ClaimedNames names;
    return names;
  }

  Status take(const std::string& name) {
    const std::lock_guard lock(m_mutex);
    auto at = m_names.find(name);
    if (at == m_names.end()) {
      ZD_TRY(const int claim, bound_to(name));
      at = m_names.emplace(name, Shared{claim, 0}).first;
    }
    ++at->second.sharers;
    return {};
  }

  void give_back(const std::string& name) {
    const std::lock_guard lock(m_mutex);
    const auto at = m_names.find(name);
    if (--at->second.sharers > 0) return;
    ::close(at->second.claim);
    m_names.erase(at);
  }

 private:
  struct Shared {
    int claim;  // socket
    int sharers;
  };
  std::mutex m_mutex;
  std::map<std::string, Shared> m_names;
};

}  // namespace

Result<std::unique_ptr<ControllerClaim>> ControllerClaim::take(const ControllerSettings& settings) {
  auto claim = std::unique_ptr<ControllerClaim>(new ControllerClaim);
  if (settings.kind != LinkKind::tcp) return claim;
  for (const std::string& address : addresses_of(settings.host)) {
    const std::string name = fmt::format("zerodrift/controller/{}:{}/{}", address, settings.port, settings.unit);
    ZD_CHECK(ClaimedNames::of_this_program().take(name));
    claim->m_names.push_back(name);
  }
  return claim;
}

ControllerClaim::~ControllerClaim() {
  for (const auto& name : m_names) ClaimedNames::of_this_program().give_back(name);
}

}  // namespace zerodrift::controller
