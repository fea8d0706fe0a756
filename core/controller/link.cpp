#include "core/controller/link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <modbus.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>
#include <utility>

namespace zerodrift::controller {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t mbap_bytes = 6;                 // transaction, protocol, length; the length counts what follows
constexpr std::size_t header_bytes = mbap_bytes + 1;  // and the unit
constexpr std::chrono::milliseconds idle{5};          // after so long without a request the wire is looked at first
constexpr int most_pieces = 8;                        // of a reply; a healthy device sends one or two
constexpr int exception_busy = 6;
constexpr int exception_acknowledge = 5;

std::string place_of(const ControllerSettings& settings) {
  return settings.kind == LinkKind::tcp ? settings.host : settings.device;
}

Error bad_reply(const std::string& what, std::string detail) {
  return Error{ErrorCode::machine_bad_reply, {{"what", what}, {"detail", std::move(detail)}}};
}

Error from_errno(int code, const std::string& what, int timeout_ms) {
  if (code == ETIMEDOUT || code == EAGAIN) {
    return Error{ErrorCode::machine_silent, {{"what", what}, {"timeout_ms", std::to_string(timeout_ms)}}};
  }
  if (code == EMBBADCRC) return bad_reply(what, "check sum wrong");
  if (code > MODBUS_ENOBASE) return bad_reply(what, modbus_strerror(code));
  return Error{ErrorCode::machine_link_lost, {{"what", what}, {"detail", std::strerror(code)}}};
}

int word_at(std::span<const std::uint8_t> bytes, std::size_t at) {
  return bytes[at] << 8 | bytes[at + 1];
}

void put_word(std::span<std::uint8_t> bytes, std::size_t at, int word) {
  bytes[at] = static_cast<std::uint8_t>(word >> 8 & 0xFF);
  bytes[at + 1] = static_cast<std::uint8_t>(word & 0xFF);
}

}  // namespace

/// An open connection; closed by its destructor.
class Link::Wire {
 public:
  static Result<std::unique_ptr<Wire>> open(const ControllerSettings& settings) {
    auto wire = std::unique_ptr<Wire>(new Wire(settings));
    const auto unreachable = [&](const char* detail) {
      return fail(ErrorCode::machine_unreachable,
                  {{"host", place_of(settings)}, {"port", std::to_string(settings.port)}, {"detail", detail}});
    };
    modbus_t* context = wire->m_context;
    if (context == nullptr) return unreachable("wrong serial settings");
    modbus_set_slave(context, settings.unit);
    modbus_set_error_recovery(context, MODBUS_ERROR_RECOVERY_NONE);
    const auto milliseconds = static_cast<std::uint32_t>(settings.timeout_ms);
    modbus_set_response_timeout(context, milliseconds / 1000, milliseconds % 1000 * 1000);
    // Without a byte timeout the response timeout bounds the whole reply, however slowly its bytes come.
    modbus_set_byte_timeout(context, 0, 0);
    if (modbus_connect(context) != 0) return unreachable(modbus_strerror(errno));
    if (wire->m_tcp) wire->wait_in_calls();
    return wire;
  }
  ~Wire() {
    if (m_context == nullptr) return;
    modbus_close(m_context);  // modbus_free does not close the socket
    modbus_free(m_context);
  }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  bool in_pieces() const { return m_pieces > most_pieces; }

  /// Bytes that nobody asked for, or the peer's end of the connection: this wire cannot be trusted any more. Right
  /// after a reply that came alone there is nothing to look for, unless the request must not be repeated.
  bool stale(bool surely) {
    if (!m_tcp) {
      modbus_flush(m_context);
      return false;
    }
    const auto last = std::exchange(m_started, SteadyClock::now());
    if (!surely && m_started - last < idle) return false;
    std::uint8_t byte = 0;
    const auto got = ::recv(modbus_get_socket(m_context), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return got >= 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
  }

  Status send(std::span<const std::uint8_t> pdu, const std::string& what) {
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> frame;
    std::size_t size = 0;
    if (m_tcp) {
      m_transaction = (m_transaction + 1) & 0xFFFF;
      put_word(frame, 0, m_transaction);
      put_word(frame, 2, 0);
      put_word(frame, 4, static_cast<int>(pdu.size()) + 1);
      size = mbap_bytes;
    }
    frame[size++] = static_cast<std::uint8_t>(m_settings.unit);
    std::copy(pdu.begin(), pdu.end(), frame.begin() + static_cast<std::ptrdiff_t>(size));
    size += pdu.size();
    if (!m_tcp) {  // adds the CRC
      const int sent = modbus_send_raw_request(m_context, frame.data(), static_cast<int>(size));
      if (sent < 0) return fail(from_errno(errno, what, m_settings.timeout_ms));
      return {};
    }
    const auto sent = ::send(modbus_get_socket(m_context), frame.data(), size, MSG_NOSIGNAL);
    if (sent < 0) return fail(from_errno(errno, what, m_settings.timeout_ms));
    if (sent != static_cast<ssize_t>(size)) return fail(from_errno(EPIPE, what, m_settings.timeout_ms));
    return {};
  }

  Result<Pdu> receive(const std::string& what) {
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH + 1> buffer;  // one more, to see bytes beyond a full frame
    int got = 0;
    if (m_tcp) {
      ZD_TRY(got, receive_tcp(buffer, what));
    } else {
      got = modbus_receive_confirmation(m_context, buffer.data());
      if (got < 0) return fail(from_errno(errno, what, m_settings.timeout_ms));
    }
    return checked(std::span(buffer).first(static_cast<std::size_t>(got)), what);
  }

 private:
  explicit Wire(const ControllerSettings& settings)
      : m_settings(settings),
        m_tcp(settings.kind == LinkKind::tcp),
        m_context(
            m_tcp ? modbus_new_tcp_pi(settings.host.c_str(), std::to_string(settings.port).c_str())
                  : modbus_new_rtu(settings.device.c_str(), settings.baud, settings.parity, 8, settings.stop_bits)) {}

  /// The library leaves the socket non-blocking. One call shall wait and receive: over a quick network a poll before
  /// each would cost a tenth of the throughput.
  void wait_in_calls() const {
    const int handle = modbus_get_socket(m_context);
    const timeval timeout{m_settings.timeout_ms / 1000, m_settings.timeout_ms % 1000 * 1000L};
    ::setsockopt(handle, SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    ::setsockopt(handle, SOL_SOCKET, SO_SNDTIMEO, &timeout, sizeof timeout);
    ::fcntl(handle, F_SETFL, ::fcntl(handle, F_GETFL) & ~O_NONBLOCK);
  }

  /// As many bytes as the frame's own length says, however slowly they come, within the timeout from the request on.
  Result<int> receive_tcp(std::span<std::uint8_t> buffer, const std::string& what) {
    const int handle = modbus_get_socket(m_context);
    std::size_t have = 0;
    std::size_t want = header_bytes;
    m_pieces = 0;
    while (have < want) {
      if (have > 0 && !wait_for_more(handle)) return fail(from_errno(ETIMEDOUT, what, m_settings.timeout_ms));
      const auto got = ::recv(handle, buffer.data() + have, buffer.size() - have, 0);
      if (got <= 0) return fail(from_errno(got == 0 ? ECONNRESET : errno, what, m_settings.timeout_ms));
      ++m_pieces;
      have += static_cast<std::size_t>(got);
      if (have < header_bytes) continue;
      want = mbap_bytes + static_cast<std::size_t>(word_at(buffer, 4));
      if (want > MODBUS_TCP_MAX_ADU_LENGTH) return fail(bad_reply(what, fmt::format("length {}", want - mbap_bytes)));
    }
    return static_cast<int>(have);
  }

  bool wait_for_more(int handle) const {
    const auto end = m_started + std::chrono::milliseconds(m_settings.timeout_ms);
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - SteadyClock::now()).count();
    pollfd wait{handle, POLLIN, 0};
    return left > 0 && ::poll(&wait, 1, static_cast<int>(left)) > 0;
  }

  /// The reply without its envelope, if the envelope is right.
  Result<Pdu> checked(std::span<const std::uint8_t> frame, const std::string& what) const {
    const std::size_t lead = m_tcp ? header_bytes : 1;
    const std::size_t trail = m_tcp ? 0 : 2;  // CRC, checked by the library
    if (frame.size() < lead + trail + 2) return fail(bad_reply(what, fmt::format("{} bytes only", frame.size())));
    if (m_tcp) {
      const int transaction = word_at(frame, 0);
      if (transaction != m_transaction) {
        return fail(bad_reply(what, fmt::format("transaction {} instead of {}", transaction, m_transaction)));
      }
      if (word_at(frame, 2) != 0) return fail(bad_reply(what, fmt::format("protocol {}", word_at(frame, 2))));
      const std::size_t length = static_cast<std::size_t>(word_at(frame, 4)) + mbap_bytes;
      if (length != frame.size()) {
        return fail(bad_reply(what, fmt::format("length {} for {} bytes", length, frame.size())));
      }
    }
    const int unit = frame[lead - 1];
    if (unit != m_settings.unit) return fail(bad_reply(what, fmt::format("unit {}, not {}", unit, m_settings.unit)));
    const auto pdu = frame.subspan(lead, frame.size() - lead - trail);
    return Pdu(pdu.begin(), pdu.end());
  }

  ControllerSettings m_settings;
  bool m_tcp;
  modbus_t* m_context;
  int m_transaction = 0;
  int m_pieces = 0;                                        // that the last reply came in
  SteadyClock::time_point m_started = SteadyClock::now();  // of the last request
};

Link::Link(ControllerSettings settings) : m_settings(std::move(settings)) {}
Link::~Link() = default;

void Link::close() {
  m_wire.reset();
}

Result<Link::Pdu> Link::exchange_once(const Pdu& request, const std::string& what, Retry retry) {
  if (m_wire && m_wire->stale(retry == Retry::no)) m_wire.reset();
  if (!m_wire) {
    ZD_TRY(m_wire, Wire::open(m_settings));
    if (m_was_connected) ++m_health.reconnects;
    m_was_connected = true;
  }
  ++m_health.requests;
  ZD_CHECK(m_wire->send(request, what));
  ZD_TRY(Pdu reply, m_wire->receive(what));
  if (m_wire->in_pieces()) ++m_health.faults["reply_in_pieces"];
  if (reply[0] == (request[0] | 0x80)) {
    const int code = reply[1];
    if (code == exception_busy || code == exception_acknowledge) return fail(ErrorCode::machine_busy, {{"what", what}});
    return fail(ErrorCode::machine_exception, {{"what", what}, {"exception", std::to_string(code)}});
  }
  if (reply[0] != request[0]) {
    return fail(bad_reply(what, fmt::format("function {} instead of {}", reply[0], request[0])));
  }
  return reply;
}

bool Link::again(const Error& error, int attempt, Retry retry) const {
  if (retry == Retry::no || attempt + 1 >= m_attempts) return false;
  if (error.code == ErrorCode::machine_exception) return false;
  // A host that has never answered is a wrong address; one that has is a pulled cable or a restart.
  return error.code != ErrorCode::machine_unreachable || m_was_connected;
}

Result<Link::Pdu> Link::exchange(const Pdu& request, const std::string& what, Retry retry) {
  for (int attempt = 0;; ++attempt) {
    auto reply = exchange_once(request, what, retry);
    if (reply) return reply;
    const ErrorCode code = reply.error().code;
    if (code != ErrorCode::machine_exception) ++m_health.faults[std::string(name_of(code))];
    if (code != ErrorCode::machine_exception && code != ErrorCode::machine_busy) m_wire.reset();
    if (!again(reply.error(), attempt, retry)) return reply;
    ++m_health.retries;
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(10 << (2 * attempt), 500)));
  }
}

Result<std::vector<std::uint16_t>> Link::read(RegisterSpace space, int address, int count, const std::string& what) {
  Pdu request(5);
  request[0] = space == RegisterSpace::holding ? 3 : 4;
  put_word(request, 1, address);
  put_word(request, 3, count);
  for (int attempt = 0;; ++attempt) {
    ZD_TRY(const Pdu reply, exchange(request, what, Retry::yes));
    const auto bytes = 2 * static_cast<std::size_t>(count);
    if (reply.size() == bytes + 2 && reply[1] == bytes) {
      std::vector<std::uint16_t> words(static_cast<std::size_t>(count));
      for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint16_t>(word_at(reply, 2 + 2 * i));
      return words;
    }
    ++m_health.faults[std::string(name_of(ErrorCode::machine_bad_reply))];
    m_wire.reset();
    if (attempt + 1 >= m_attempts)
      return fail(bad_reply(what, fmt::format("{} bytes for {}", reply.size() - 2, bytes)));
  }
}

Status Link::write(int address, std::span<const std::uint16_t> words, const std::string& what, Retry retry) {
  const bool one = words.size() == 1;
  Pdu request(one ? 5 : 6 + 2 * words.size());
  request[0] = one ? 6 : 16;
  put_word(request, 1, address);
  if (!one) {
    put_word(request, 3, static_cast<int>(words.size()));
    request[5] = static_cast<std::uint8_t>(2 * words.size());
  }
  for (std::size_t i = 0; i < words.size(); ++i) put_word(request, (one ? 3 : 6) + 2 * i, words[i]);
  // Function 16 echoes address and count. Function 6 echoes address and value, but a register that clears itself is
  // answered with its new value, nought, by some devices. Any other value is not what was meant to be written.
  const auto echoed = [&](const Pdu& reply) {
    if (reply.size() != 5 || !std::equal(reply.begin() + 1, reply.begin() + 3, request.begin() + 1)) return false;
    return word_at(reply, 3) == word_at(request, 3) || (one && word_at(reply, 3) == 0);
  };
  for (int attempt = 0;; ++attempt) {
    ZD_TRY(const Pdu reply, exchange(request, what, retry));
    if (echoed(reply)) return {};
    ++m_health.faults[std::string(name_of(ErrorCode::machine_bad_reply))];
    m_wire.reset();
    if (retry == Retry::no || attempt + 1 >= m_attempts) return fail(bad_reply(what, "echo of a write differs"));
  }
}

}  // namespace zerodrift::controller
