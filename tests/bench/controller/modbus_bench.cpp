// Modbus round trips through Link against a bare TCP ping-pong of the very same frames with the same peer, turn about
// in one run, so that the load of the machine meets both alike. The peer answers each request with a frame made before.
// Figures, no assertions.

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sched.h>
#include <sys/socket.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <thread>

#include "core/controller/link.h"

namespace {

using namespace zerodrift;
using namespace zerodrift::controller;
using Bytes = std::vector<std::uint8_t>;

constexpr std::size_t mbap_bytes = 6;  // transaction, protocol, length; the length counts what follows

struct Exchange {
  std::string name;
  Bytes request;  // transaction 0
  Bytes reply;
  std::function<bool(Link&)> through_link;
};

void append(Bytes& bytes, std::size_t word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
}

Bytes framed(const Bytes& pdu) {
  Bytes frame;
  append(frame, 0);
  append(frame, 0);
  append(frame, pdu.size() + 1);
  frame.push_back(1);  // unit
  frame.insert(frame.end(), pdu.begin(), pdu.end());
  return frame;
}

Exchange reading(std::size_t count) {
  Bytes request{3};
  append(request, 100);
  append(request, count);
  Bytes reply{3, static_cast<std::uint8_t>(2 * count)};
  for (std::size_t i = 0; i < count; ++i) append(reply, i);
  return {fmt::format("read {}", count), framed(request), framed(reply), [count](Link& link) {
            return link.read(RegisterSpace::holding, 100, static_cast<int>(count), "bench").has_value();
          }};
}

Exchange writing(std::size_t count) {
  Bytes request{16};
  append(request, 100);
  append(request, count);
  Bytes reply = request;
  request.push_back(static_cast<std::uint8_t>(2 * count));
  std::vector<std::uint16_t> words(count, 7);
  for (const std::uint16_t word : words) append(request, word);
  return {fmt::format("write {}", count), framed(request), framed(reply),
          [words](Link& link) { return link.write(100, words, "bench").has_value(); }};
}

void quick(int handle) {
  const int on = 1;
  ::setsockopt(handle, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
}

/// Receives until `bytes` is full; false when the connection ended.
bool fill(int handle, Bytes& bytes) {
  std::size_t have = 0;
  while (have < bytes.size()) {
    const auto got = ::recv(handle, bytes.data() + have, bytes.size() - have, 0);
    if (got <= 0) return false;
    have += static_cast<std::size_t>(got);
  }
  return true;
}

bool send_all(int handle, const Bytes& bytes) {
  return ::send(handle, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
}

/// Listens on a free port; answers on one connection after the other until the listener is closed.
class Peer {
 public:
  explicit Peer(const Exchange& exchange) : m_exchange(exchange), m_listener(::socket(AF_INET, SOCK_STREAM, 0)) {
    m_address.sin_family = AF_INET;
    m_address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof m_address;
    ::bind(m_listener, reinterpret_cast<const sockaddr*>(&m_address), size);
    ::listen(m_listener, 4);
    ::getsockname(m_listener, reinterpret_cast<sockaddr*>(&m_address), &size);
    for (int i = 0; i < 2; ++i) m_threads.emplace_back([this] { serve(); });  // the link and the bare socket
  }
  ~Peer() {
    ::shutdown(m_listener, SHUT_RDWR);
    for (auto& thread : m_threads) thread.join();
    ::close(m_listener);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  const sockaddr_in& address() const { return m_address; }

 private:
  void serve() {
    const int host = ::accept(m_listener, nullptr, nullptr);
    if (host < 0) return;
    quick(host);
    Bytes request(m_exchange.request.size());
    Bytes reply = m_exchange.reply;
    while (fill(host, request)) {
      std::copy(request.begin(), request.begin() + 2, reply.begin());  // the transaction
      if (!send_all(host, reply)) break;
    }
    ::close(host);
  }

  const Exchange& m_exchange;
  int m_listener;
  sockaddr_in m_address{};
  std::vector<std::thread> m_threads;
};

class Bare {
 public:
  explicit Bare(const sockaddr_in& address) : m_handle(::socket(AF_INET, SOCK_STREAM, 0)) {
    quick(m_handle);
    m_connected = ::connect(m_handle, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  }
  ~Bare() { ::close(m_handle); }
  Bare(const Bare&) = delete;
  Bare& operator=(const Bare&) = delete;

  bool exchange(const Exchange& what) {
    m_reply.resize(what.reply.size());
    return m_connected && send_all(m_handle, what.request) && fill(m_handle, m_reply);
  }

 private:
  int m_handle;
  bool m_connected = false;
  Bytes m_reply;
};

template <class Work>
double per_second(int times, bool& good, Work work) {
  const auto start = std::chrono::steady_clock::now();
  for (int i = 0; i < times; ++i) good = work() && good;
  return times / std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

/// False when an exchange failed.
bool measure(const Exchange& exchange, int rounds, int times) {
  const Peer peer(exchange);
  bool good = true;
  std::vector<double> bare_rates;
  std::vector<double> link_rates;
  std::vector<double> ratios;
  {
    Bare bare(peer.address());
    ControllerSettings settings;
    settings.port = ntohs(peer.address().sin_port);
    Link link(settings);
    good = bare.exchange(exchange) && exchange.through_link(link);
    for (int round = 0; good && round < rounds; ++round) {
      bare_rates.push_back(per_second(times, good, [&] { return bare.exchange(exchange); }));
      link_rates.push_back(per_second(times, good, [&] { return exchange.through_link(link); }));
      ratios.push_back(link_rates.back() / bare_rates.back());
    }
  }
  if (!good) return false;
  fmt::print("{:<10} {:>12.0f} {:>12.0f} {:>8.3f}\n", exchange.name, median(bare_rates), median(link_rates),
             median(ratios));
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Round trips a second through the checked Modbus connection, against bare sockets");
  int rounds = 60;
  int times = 1000;
  app.add_option("--rounds", rounds, "Pairs of runs; the median is printed")->check(CLI::Range(1, 100000));
  app.add_option("--times", times, "Round trips in a run")->check(CLI::Range(1, 10000000));
  bool any_core = false;
  app.add_flag("--any-core", any_core, "Let the scheduler place the threads: then its choice decides, not the code");
  CLI11_PARSE(app, argc, argv);
  if (!any_core) {
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(static_cast<unsigned>(::sched_getcpu()), &one);
    ::sched_setaffinity(0, sizeof one, &one);
  }
  fmt::print("{:<10} {:>12} {:>12} {:>8}\n", "request", "bare 1/s", "link 1/s", "ratio");
  for (const auto& exchange : {reading(1), reading(64), reading(125), writing(64), writing(123)}) {
    if (measure(exchange, rounds, times)) continue;
    fmt::print(stderr, "{}: an exchange failed\n", exchange.name);
    return 1;
  }
  return 0;
}
