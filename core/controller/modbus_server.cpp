#include "core/controller/modbus_server.h"

#include <arpa/inet.h>
#include <modbus.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <list>
#include <mutex>
#include <thread>

namespace zerodrift::controller {
namespace {

constexpr int header_bytes = 7;         // MBAP: transaction, protocol, length, unit
constexpr int largest_frame = 6 + 512;  // more than the standard's 260, so that too long a request gets its exception
constexpr int function_read = 3;
constexpr int function_write_one = 6;
constexpr int function_write = 16;
constexpr std::size_t most_clients = 32;

using Bytes = std::vector<std::uint8_t>;

class Socket {
 public:
  explicit Socket(int handle = -1) : m_handle(handle) {}
  ~Socket() { close(); }
  Socket(Socket&& other) noexcept : m_handle(std::exchange(other.m_handle, -1)) {}
  Socket& operator=(Socket&& other) noexcept {
    std::swap(m_handle, other.m_handle);
    return *this;
  }
  int handle() const { return m_handle; }
  void close() {
    if (m_handle >= 0) ::close(std::exchange(m_handle, -1));
  }

 private:
  int m_handle;
};

int word_at(const Bytes& frame, std::size_t at) {
  return frame.size() >= at + 2 ? (frame[at] << 8) | frame[at + 1] : -1;
}

/// Waits in short turns, so that the end of the server is never more than a turn away.
bool readable(int handle, const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    pollfd wait{handle, POLLIN, 0};
    const int ready = ::poll(&wait, 1, 100);
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
  }
  return false;
}

bool receive_exactly(int handle, Bytes& frame, std::size_t count, const std::stop_token& stop) {
  std::size_t have = frame.size();
  const std::size_t want = have + count;
  frame.resize(want);
  while (have < want) {
    if (!readable(handle, stop)) return false;
    const auto got = ::recv(handle, frame.data() + have, want - have, 0);
    if (got <= 0) return false;
    have += static_cast<std::size_t>(got);
  }
  return true;
}

/// One whole request with its header; false at the end of the connection or when the bytes are not Modbus.
bool receive_request(int handle, Bytes& frame, const std::stop_token& stop) {
  frame.clear();
  if (!receive_exactly(handle, frame, header_bytes, stop)) return false;
  const int protocol = word_at(frame, 2);
  const int length = word_at(frame, 4);  // counts the unit and what follows
  if (protocol != 0 || length < 2 || length + 6 > largest_frame) return false;
  return receive_exactly(handle, frame, static_cast<std::size_t>(length) - 1, stop);
}

bool send_all(int handle, const std::uint8_t* bytes, std::size_t count) {
  while (count > 0) {
    const auto sent = ::send(handle, bytes, count, MSG_NOSIGNAL);
    if (sent <= 0) return false;
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}

/// libmodbus forms the replies; it writes them into a pair of sockets, where they can be spoilt before they are sent.
class ReplyMaker {
 public:
  ReplyMaker() : m_context(modbus_new_tcp("127.0.0.1", 1502)) {
    int pair[2] = {-1, -1};
    if (m_context == nullptr || ::socketpair(AF_UNIX, SOCK_STREAM, 0, pair) != 0) return;
    m_in = Socket(pair[0]);
    m_out = Socket(pair[1]);
    modbus_set_socket(m_context, m_in.handle());
  }
  ~ReplyMaker() {
    if (m_context != nullptr) modbus_free(m_context);
  }
  ReplyMaker(const ReplyMaker&) = delete;
  ReplyMaker& operator=(const ReplyMaker&) = delete;

  bool good() const { return m_in.handle() >= 0; }

  Bytes exception(const Bytes& request, ModbusException code) {
    // the library gives exceptions for codes it does not know as well, but not for an empty function byte
    const int sent = modbus_reply_exception(m_context, request.data(), static_cast<unsigned>(code));
    return taken(sent);
  }
  /// Reply to a request whose counts have been checked; values are what a read returns.
  Bytes answer(const Bytes& request, int address, const std::vector<std::uint16_t>& values) {
    modbus_mapping_t* mapping = modbus_mapping_new_start_address(0, 0, 0, 0, static_cast<unsigned>(address),
                                                                 static_cast<unsigned>(values.size()), 0, 0);
    if (mapping == nullptr) return {};
    std::copy(values.begin(), values.end(), mapping->tab_registers);
    const int sent = modbus_reply(m_context, request.data(), static_cast<int>(request.size()), mapping);
    modbus_mapping_free(mapping);
    return taken(sent);
  }

 private:
  Bytes taken(int count) {
    Bytes reply(static_cast<std::size_t>(std::max(count, 0)));
    std::size_t have = 0;
    while (have < reply.size()) {
      const auto got = ::recv(m_out.handle(), reply.data() + have, reply.size() - have, 0);
      if (got <= 0) return {};
      have += static_cast<std::size_t>(got);
    }
    return reply;
  }

  modbus_t* m_context;
  Socket m_in;
  Socket m_out;
};

struct Request {
  int function = 0;
  int address = 0;
  int count = 0;
  std::vector<std::uint16_t> values;
};

tl::expected<Request, ModbusException> understood(const Bytes& frame) {
  Request request;
  request.function = frame[header_bytes];
  if (request.function != function_read && request.function != function_write_one &&
      request.function != function_write) {
    return tl::unexpected(ModbusException::illegal_function);
  }
  request.address = word_at(frame, 8);
  request.count = word_at(frame, 10);
  const auto bad = tl::unexpected(ModbusException::illegal_value);
  if (request.address < 0 || request.count < 0) return bad;
  if (request.function == function_write_one) {
    if (frame.size() != 12) return bad;
    request.values = {static_cast<std::uint16_t>(request.count)};
    request.count = 1;
    return request;
  }
  const int most = request.function == function_read ? MODBUS_MAX_READ_REGISTERS : MODBUS_MAX_WRITE_REGISTERS;
  if (request.count < 1 || request.count > most) return bad;
  if (request.function == function_read) {
    if (frame.size() != 12) return bad;
  } else {
    const auto bytes = static_cast<std::size_t>(request.count) * 2;
    if (frame.size() != 13 + bytes || frame[12] != bytes) return bad;
    for (std::size_t i = 0; i < bytes; i += 2) {
      request.values.push_back(static_cast<std::uint16_t>(word_at(frame, 13 + i)));
    }
  }
  if (request.address + request.count > 65536) return tl::unexpected(ModbusException::illegal_address);
  return request;
}

}  // namespace

class ModbusServer::Impl {
 public:
  Impl(ModbusServerOptions options, Socket listener, int port)
      : m_options(std::move(options)), m_listener(std::move(listener)), m_port(port) {
    m_thread = std::jthread([this](const std::stop_token& stop) { accept_clients(stop); });
  }
  int port() const { return m_port; }

 private:
  struct Client {
    std::atomic<bool> done{false};
    std::jthread thread;
  };

  void accept_clients(const std::stop_token& stop) {
    while (readable(m_listener.handle(), stop)) {
      Socket peer(::accept4(m_listener.handle(), nullptr, nullptr, SOCK_CLOEXEC));
      m_clients.remove_if([](const Client& client) { return client.done.load(); });
      if (peer.handle() < 0 || m_clients.size() >= most_clients) continue;
      const int on = 1;
      ::setsockopt(peer.handle(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      const timeval send_timeout{5, 0};  // a client that never reads must not hold its thread for ever
      ::setsockopt(peer.handle(), SOL_SOCKET, SO_SNDTIMEO, &send_timeout, sizeof send_timeout);
      Client& client = m_clients.emplace_back();
      client.thread = std::jthread([this, &client, socket = std::move(peer)](const std::stop_token& own) mutable {
        serve(socket.handle(), own);
        socket.close();
        client.done = true;
      });
    }
    m_clients.clear();
  }

  void serve(int handle, const std::stop_token& stop) {
    ReplyMaker maker;
    Bytes request;
    while (maker.good() && receive_request(handle, request, stop)) {
      if (!answer_one(handle, request, maker, stop)) return;
    }
  }

  bool answer_one(int handle, const Bytes& frame, ReplyMaker& maker, const std::stop_token& stop) {
    const int unit = frame[6];
    if (unit != m_options.unit && unit != 0 && unit != 255) {
      return deliver(handle, maker.exception(frame, ModbusException::gateway_target_silent), {}, stop);
    }
    const auto request = m_options.without_functions.contains(frame[header_bytes])
                             ? tl::expected<Request, ModbusException>(tl::unexpected(ModbusException::illegal_function))
                             : understood(frame);
    if (!request) return deliver(handle, maker.exception(frame, request.error()), {}, stop);
    const bool is_write = request->function != function_read;
    const ReplyFault fault = m_options.fault ? m_options.fault(is_write) : ReplyFault{};
    if (fault.kind == ReplyFault::Kind::drop) return false;
    if (fault.kind == ReplyFault::Kind::busy) {
      return deliver(handle, maker.exception(frame, ModbusException::busy), fault, stop);
    }
    if (fault.kind == ReplyFault::Kind::refused || fault.kind == ReplyFault::Kind::refused_after) {
      if (is_write && fault.kind == ReplyFault::Kind::refused_after) {
        static_cast<void>(m_options.write(request->address, request->values));
      }
      return deliver(handle, maker.exception(frame, fault.exception), fault, stop);
    }
    if (is_write) {
      if (const auto refused = m_options.write(request->address, request->values)) {
        return deliver(handle, maker.exception(frame, *refused), fault, stop);
      }
      return deliver(handle, maker.answer(frame, request->address, request->values), fault, stop);
    }
    const RegisterReply values = m_options.read(request->address, request->count);
    if (!values) return deliver(handle, maker.exception(frame, values.error()), fault, stop);
    return deliver(handle, maker.answer(frame, request->address, *values), fault, stop);
  }

  static void pause(std::chrono::milliseconds delay, const std::stop_token& stop) {
    const auto end = std::chrono::steady_clock::now() + delay;
    while (!stop.stop_requested() && std::chrono::steady_clock::now() < end) {
      const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
      std::this_thread::sleep_for(std::min(left, std::chrono::milliseconds(50)));
    }
  }

  static bool deliver(int handle, Bytes reply, const ReplyFault& fault, const std::stop_token& stop) {
    if (reply.size() < 2) return false;
    if (fault.kind == ReplyFault::Kind::bytewise) {
      for (const std::uint8_t byte : reply) {
        if (!send_all(handle, &byte, 1)) return false;
        pause(fault.delay, stop);
      }
      return true;
    }
    pause(fault.delay, stop);
    if (fault.kind == ReplyFault::Kind::wrong_transaction) {
      const int next = word_at(reply, 0) + 1;
      reply[0] = static_cast<std::uint8_t>(next >> 8);
      reply[1] = static_cast<std::uint8_t>(next);
    }
    if (fault.kind == ReplyFault::Kind::wrong_unit) ++reply[6];
    if (fault.kind == ReplyFault::Kind::truncated) reply.resize(reply.size() / 2);
    return send_all(handle, reply.data(), reply.size());
  }

  ModbusServerOptions m_options;
  Socket m_listener;
  int m_port;
  std::list<Client> m_clients;  // only the accepting thread touches the list
  std::jthread m_thread;
};

namespace {

Result<Socket> listen_on(const ModbusServerOptions& options, int& port) {
  const auto unavailable = [&](const char* detail) {
    return fail(ErrorCode::port_unavailable,
                {{"host", options.host}, {"port", std::to_string(options.port)}, {"detail", detail}});
  };
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(options.port));
  const std::string host = options.host == "localhost" ? "127.0.0.1" : options.host;
  if (::inet_pton(AF_INET, host.c_str(), &address.sin_addr) != 1) return unavailable("not an IPv4 address");
  Socket listener(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (listener.handle() < 0) return unavailable(std::strerror(errno));
  const int on = 1;
  ::setsockopt(listener.handle(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  socklen_t size = sizeof address;
  auto* generic = reinterpret_cast<sockaddr*>(&address);
  if (::bind(listener.handle(), generic, size) != 0 || ::listen(listener.handle(), 8) != 0 ||
      ::getsockname(listener.handle(), generic, &size) != 0) {
    return unavailable(std::strerror(errno));
  }
  port = ntohs(address.sin_port);
  return listener;
}

}  // namespace

Result<std::unique_ptr<ModbusServer>> ModbusServer::start(ModbusServerOptions options) {
  int port = 0;
  ZD_TRY(Socket listener, listen_on(options, port));
  return std::unique_ptr<ModbusServer>(
      new ModbusServer(std::make_unique<Impl>(std::move(options), std::move(listener), port)));
}

ModbusServer::ModbusServer(std::unique_ptr<Impl> impl) : m_impl(std::move(impl)) {}
ModbusServer::~ModbusServer() = default;

int ModbusServer::port() const {
  return m_impl->port();
}

}  // namespace zerodrift::controller
