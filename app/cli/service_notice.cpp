#include "app/cli/service_notice.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <string_view>

namespace zerodrift::cli {

ServiceNotice::ServiceNotice() {
  const char* path = std::getenv("NOTIFY_SOCKET");
  sockaddr_un address{};
  if (path == nullptr || (path[0] != '/' && path[0] != '@')) return;
  const std::string_view name(path);
  if (name.size() >= sizeof address.sun_path) return;
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, name.data(), name.size());
  if (path[0] == '@') address.sun_path[0] = '\0';  // the abstract name space
  m_socket = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
  if (m_socket < 0 || ::connect(m_socket, reinterpret_cast<const sockaddr*>(&address), size) == 0) return;
  ::close(m_socket);
  m_socket = -1;
}

ServiceNotice::~ServiceNotice() {
  if (m_socket >= 0) ::close(m_socket);
}

void ServiceNotice::say(const std::string& lines) const {
  if (m_socket >= 0) static_cast<void>(::send(m_socket, lines.data(), lines.size(), MSG_NOSIGNAL));
}

}  // namespace zerodrift::cli
