// Any bytes as what a controller sends back, in one piece or in many: an error, or as many words as were asked for.
// A server of our own answers every request with the next bytes and closes; nothing may hang or be read beyond its end.

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "core/controller/link.h"

namespace {

class Server {
 public:
  Server() {
    m_listener = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    if (::bind(m_listener, reinterpret_cast<sockaddr*>(&address), length) != 0 || ::listen(m_listener, 8) != 0 ||
        ::getsockname(m_listener, reinterpret_cast<sockaddr*>(&address), &length) != 0) {
      std::abort();
    }
    port = ntohs(address.sin_port);
    std::thread([this] { serve(); }).detach();
  }

  /// A copy: when the host is too busy to be answered in time, the answer comes while the next input is on.
  void answer_with(std::vector<std::uint8_t> bytes) {
    const std::scoped_lock lock(m_mutex);
    m_answer = std::move(bytes);
  }

  int port = 0;

 private:
  std::vector<std::uint8_t> answer() {
    const std::scoped_lock lock(m_mutex);
    return m_answer;
  }

  void serve() {
    for (;;) {
      const int peer = ::accept(m_listener, nullptr, nullptr);
      if (peer < 0) continue;
      std::uint8_t request[260];
      const auto got = ::recv(peer, request, sizeof request, 0);
      std::vector<std::uint8_t> reply = answer();
      // The envelope is made right half of the time, so that what is behind it is reached.
      if (got >= 8 && reply.size() >= 9 && reply[0] % 2 == 0) {
        reply[0] = request[0];
        reply[1] = request[1];
        reply[2] = reply[3] = 0;
        reply[4] = static_cast<std::uint8_t>((reply.size() - 6) >> 8);
        reply[5] = static_cast<std::uint8_t>((reply.size() - 6) & 0xFF);
        reply[6] = request[6];
      }
      if (!reply.empty()) static_cast<void>(::send(peer, reply.data(), reply.size(), MSG_NOSIGNAL));
      ::close(peer);
    }
  }

  int m_listener = -1;
  std::mutex m_mutex;
  std::vector<std::uint8_t> m_answer;
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  namespace controller = zerodrift::controller;
  static auto* server = new Server;
  if (size > 300) size = 300;
  server->answer_with({bytes, bytes + size});
  controller::ControllerSettings settings;
  settings.port = server->port;
  settings.timeout_ms = 500;
  controller::Link link(settings);
  link.set_attempts(1);
  const auto words = link.read(controller::RegisterSpace::holding, 0, 3, "fuzz");
  if (words && words->size() != 3) std::abort();
  const std::uint16_t out[2] = {1, 2};
  static_cast<void>(link.write(7, out, "fuzz", controller::Retry::no));
  return 0;
}
