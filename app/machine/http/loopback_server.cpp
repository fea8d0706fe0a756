#include "app/machine/http/loopback_server.h"

#include <sys/socket.h>

#include <cerrno>
#include <chrono>
#include <cstring>

namespace zerodrift::machine {
namespace {

constexpr std::size_t most_connections = 24;  // a stream holds its thread; waiting threads cost nothing
constexpr int send_buffer_bytes = 32 * 1024;  // less than a frame: what a slow client has not taken is not yet rendered
const char* const host = "127.0.0.1";

void set_socket_options(socket_t socket) {
  // Not SO_REUSEPORT, the library's default: a second server on the port must be told that it is taken.
  const int yes = 1;
  setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof(yes));
  setsockopt(socket, SOL_SOCKET, SO_SNDBUF, &send_buffer_bytes, sizeof(send_buffer_bytes));
}

}  // namespace

LoopbackServer::LoopbackServer() {
  m_http.set_socket_options(set_socket_options);
  m_http.set_tcp_nodelay(true);
  m_http.set_write_timeout(2);
  m_http.set_keep_alive_timeout(2);
  m_http.new_task_queue = [] { return new httplib::ThreadPool(most_connections); };
}

LoopbackServer::~LoopbackServer() {
  stop();
}

Result<int> LoopbackServer::start(int port) {
  const int bound = port == 0 ? m_http.bind_to_any_port(host) : m_http.bind_to_port(host, port) ? port : -1;
  if (bound <= 0) {
    return fail(ErrorCode::port_unavailable,
                {{"host", host}, {"port", std::to_string(port)}, {"detail", std::strerror(errno)}});
  }
  m_listener = std::thread([this] { m_http.listen_after_bind(); });
  while (!m_http.is_running()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return bound;
}

void LoopbackServer::stop() {
  if (!m_listener.joinable()) return;
  m_http.stop();
  m_listener.join();
}

}  // namespace zerodrift::machine
