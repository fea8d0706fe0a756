#include "core/controller/link.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <modbus.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <optional>
#include <thread>
#include <utility>

#include "core/acquisition/machine_fault.h"
#include "core/controller/rtu_reply.h"
#include "core/controller/serial_line.h"

namespace zerodrift::controller {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::size_t mbap_bytes = 6;                 // transaction, protocol, length; the length counts what follows
constexpr std::size_t header_bytes = mbap_bytes + 1;  // and the unit
constexpr std::chrono::milliseconds idle{5};          // after so long without a request the wire is looked at first
constexpr int most_pieces = 8;                        // of a reply; a healthy device sends one or two
constexpr int exception_function = 1;
constexpr int function_read_holding = 3;
constexpr int function_write_one = 6;
constexpr int function_write = 16;
constexpr std::size_t longest_serial_read = 256;

std::string place_of(const ControllerSettings& settings) {
  return settings.kind == LinkKind::tcp ? settings.host : settings.device;
}

std::string name_of_function(int function) {
  switch (function) {
    case function_read_holding:
      return "3 (read holding registers)";
    case 4:
      return "4 (read input registers)";
    case function_write_one:
      return "6 (write a single register)";
    default:
      return "16 (write several registers)";
  }
}

Error bad_reply(const std::string& what, std::string detail) {
  return Error{ErrorCode::machine_bad_reply, {{"what", what}, {"detail", std::move(detail)}}};
}

Error from_errno(int code, const std::string& what, int timeout_ms) {
  if (code == ETIMEDOUT || code == EAGAIN) {
    return Error{ErrorCode::machine_silent, {{"what", what}, {"timeout_ms", std::to_string(timeout_ms)}}};
  }
  if (code > MODBUS_ENOBASE) return bad_reply(what, modbus_strerror(code));
  return Error{ErrorCode::machine_link_lost, {{"what", what}, {"detail", std::strerror(code)}}};
}

Error function_missing(int function, const std::string& what) {
  return Error{ErrorCode::machine_function_missing, {{"what", what}, {"function", name_of_function(function)}}};
}

/// Modbus application protocol V1.1b3, clause 7.
Error exception_error(int exception, const std::string& what) {
  switch (exception) {
    case 4:
      return Error{ErrorCode::machine_failed, {{"what", what}}};
    case 5:  // accepted, and still at it
    case 6:
      return Error{ErrorCode::machine_busy, {{"what", what}}};
    case 10:
    case 11:
      return Error{ErrorCode::machine_gateway, {{"what", what}, {"exception", std::to_string(exception)}}};
    default:
      return Error{ErrorCode::machine_exception, {{"what", what}, {"exception", std::to_string(exception)}}};
  }
}

/// The device's own answer, if not the one that was hoped for.
bool answered(const Error& error) {
  switch (error.code) {
    case ErrorCode::machine_busy:
    case ErrorCode::machine_gateway:
    case ErrorCode::machine_failed:
    case ErrorCode::machine_exception:
    case ErrorCode::machine_function_missing:
      return true;
    default:
      return false;
  }
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
    if (modbus_connect(context) != 0) {
      // The library leaves "in progress" behind when its time is over.
      if (errno != EINPROGRESS && errno != ETIMEDOUT) return unreachable(modbus_strerror(errno));
      return unreachable(fmt::format("no answer within {} ms", settings.timeout_ms).c_str());
    }
    if (wire->m_tcp) wire->wait_in_calls();
    if (!wire->m_tcp) modbus_flush(context);  // what came late for a former connection
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
    if (!surely && SteadyClock::now() - m_started < idle) return false;
    std::uint8_t byte = 0;
    const auto got = ::recv(modbus_get_socket(m_context), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return got >= 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
  }

  Status send(std::span<const std::uint8_t> pdu, const std::string& what) {
    m_started = SteadyClock::now();
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
    if (!m_tcp) {
      m_sent.assign(frame.begin(), frame.begin() + static_cast<std::ptrdiff_t>(size));
      append_rtu_crc(m_sent);
      // Adds the CRC by itself.
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
    if (!m_tcp) return receive_rtu(what);
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH + 1> buffer;  // one more, to see bytes beyond a full frame
    ZD_TRY(const int got, receive_tcp(buffer, what));
    return checked(std::span(buffer).first(static_cast<std::size_t>(got)), what);
  }

  bool is_serial() const { return !m_tcp; }
  LocalEcho echo() const { return m_echo; }
  bool had_zeros() const { return m_zeros; }

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

  /// The library's own receiving takes whatever comes first for the reply.
  Result<Pdu> receive_rtu(const std::string& what) {
    const int handle = modbus_get_socket(m_context);
    RtuReply reply(m_sent, m_echo);
    std::array<std::uint8_t, longest_serial_read> buffer;
    while (reply.state() == RtuReply::State::incomplete) {
      if (!wait_for_more(handle)) return fail(from_errno(ETIMEDOUT, what, m_settings.timeout_ms));
      const auto got = ::read(handle, buffer.data(), buffer.size());
      if (got < 0 && (errno == EAGAIN || errno == EINTR)) continue;
      if (got <= 0) return fail(from_errno(got == 0 ? EIO : errno, what, m_settings.timeout_ms));
      reply.add(std::span(buffer).first(static_cast<std::size_t>(got)));
      m_echo = reply.echo();
      m_zeros = m_zeros || reply.had_zeros();
    }
    if (reply.state() == RtuReply::State::spoilt) return fail(bad_reply(what, reply.detail()));
    return checked(reply.frame(), what);
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
    if (frame.size() < lead + 2) return fail(bad_reply(what, fmt::format("{} bytes only", frame.size())));
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
    const auto pdu = frame.subspan(lead);
    return Pdu(pdu.begin(), pdu.end());
  }

  ControllerSettings m_settings;
  bool m_tcp;
  modbus_t* m_context;
  int m_transaction = 0;
  LocalEcho m_echo = LocalEcho::unknown;
  bool m_zeros = false;                                    // before a reply
  std::vector<std::uint8_t> m_sent;                        // the last request over the serial line, with its CRC
  int m_pieces = 0;                                        // that the last reply came in
  SteadyClock::time_point m_started = SteadyClock::now();  // of the last request
};

Link::Link(ControllerSettings settings) : m_settings(std::move(settings)) {
  if (m_settings.kind == LinkKind::rtu) m_line = SerialLine::of(m_settings.device);
}
Link::~Link() = default;

void Link::close() {
  m_wire.reset();
}

Result<Link::Pdu> Link::exchange_once(const Pdu& request, const std::string& what, Retry retry) {
  std::optional<SerialLine::Turn> turn;
  if (m_line) {
    turn.emplace(*m_line);
    m_line->wait_for_peace();
  }
  auto reply = exchange_in_turn(request, what, retry);
  // Over a serial line nothing tells a late reply from the answer to the next question.
  if (!reply && m_line && m_wire && !answered(reply.error())) {
    m_line->leave_in_peace(std::chrono::milliseconds(m_settings.timeout_ms));
  }
  return reply;
}

Result<Link::Pdu> Link::exchange_in_turn(const Pdu& request, const std::string& what, Retry retry) {
  if (m_wire && m_wire->stale(retry == Retry::no)) m_wire.reset();
  if (!m_wire) {
    if (m_line) ZD_CHECK(m_line->claim());
    ZD_TRY(m_wire, Wire::open(m_settings));
    if (m_was_connected) ++m_health.reconnects;
    m_was_connected = true;
  }
  ZD_CHECK(find_local_echo(request, what));
  ++m_health.requests;
  ZD_CHECK(m_wire->send(request, what));
  auto received = m_wire->receive(what);
  keep_remarks();
  ZD_TRY(Pdu reply, std::move(received));
  if (m_wire->in_pieces()) ++m_health.faults["reply_in_pieces"];
  if (reply[0] == (request[0] | 0x80)) {
    const bool unknown = reply[1] == exception_function && !m_answered.contains(request[0]);
    return fail(unknown ? function_missing(request[0], what) : exception_error(reply[1], what));
  }
  if (reply[0] != request[0]) {
    return fail(bad_reply(what, fmt::format("function {} instead of {}", reply[0], request[0])));
  }
  m_answered.insert(request[0]);
  return reply;
}

/// On a serial line the reply to function 6 is the request once more. Where it is not known whether the adapter hears
/// itself, a read tells first; what it reads is nobody's business.
Status Link::find_local_echo(const Pdu& request, const std::string& what) {
  if (!m_wire->is_serial() || request[0] != function_write_one || m_wire->echo() != LocalEcho::unknown) return {};
  ++m_health.requests;
  ZD_CHECK(m_wire->send(Pdu{function_read_holding, request[1], request[2], 0, 1}, what));
  ZD_CHECK(m_wire->receive(what).map([](const Pdu&) {}));
  keep_remarks();
  return {};
}

void Link::keep_remarks() {
  const auto keep = [this](bool so, const char* remark) {
    auto& all = m_health.remarks;
    if (so && std::find(all.begin(), all.end(), remark) == all.end()) all.emplace_back(remark);
  };
  keep(m_wire && m_wire->echo() == LocalEcho::heard,
       "the serial adapter hears what it sends (local echo); the copies are dropped, its echo is better switched off");
  keep(m_wire && m_wire->had_zeros(),
       "zero bytes come before the replies and are dropped; check the termination and the bias of the serial line");
  keep(m_without_6, "the controller has no function 6 (write a single register); function 16 is used");
}

bool Link::again(const Error& error, int attempt, Retry retry) const {
  if (retry == Retry::no || attempt + 1 >= m_attempts || !acquisition::may_pass(error)) return false;
  // A host that has never answered is a wrong address; one that has is a pulled cable or a restart.
  return error.code != ErrorCode::machine_unreachable || m_was_connected;
}

Result<Link::Pdu> Link::exchange(const Pdu& request, const std::string& what, Retry retry) {
  for (int attempt = 0;; ++attempt) {
    auto reply = exchange_once(request, what, retry);
    if (reply) return reply;
    const ErrorCode code = reply.error().code;
    if (acquisition::may_pass(reply.error())) ++m_health.faults[std::string(name_of(code))];
    if (!answered(reply.error())) m_wire.reset();
    if (!again(reply.error(), attempt, retry)) return reply;
    ++m_health.retries;
    std::this_thread::sleep_for(std::chrono::milliseconds(std::min(10 << (2 * attempt), 500)));
  }
}

Result<std::vector<std::uint16_t>> Link::read(RegisterSpace space, int address, int count, const std::string& what) {
  Pdu request(5);
  request[0] = space == RegisterSpace::holding ? function_read_holding : 4;
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
  const auto is_missing = [](const Status& done) {
    return !done && done.error().code == ErrorCode::machine_function_missing;
  };
  const bool by_6 = words.size() == 1 && !m_without_6;
  const Status done = write_by(by_6 ? function_write_one : function_write, address, words, what, retry);
  if (!by_6 || !is_missing(done)) return done;
  const Status by_16 = write_by(function_write, address, words, what, retry);
  if (is_missing(by_16)) {
    return fail(ErrorCode::machine_function_missing, {{"what", what}, {"function", "6 or 16 (write registers)"}});
  }
  m_without_6 = by_16.has_value();
  keep_remarks();
  return by_16;
}

Status Link::write_by(int function, int address, std::span<const std::uint16_t> words, const std::string& what,
                      Retry retry) {
  const bool one = function == function_write_one;
  Pdu request(one ? 5 : 6 + 2 * words.size());
  request[0] = static_cast<std::uint8_t>(function);
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
