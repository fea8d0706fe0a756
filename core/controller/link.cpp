#include "core/controller/link.h"

#include <fmt/format.h>
#include <modbus.h>
#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <thread>

namespace zerodrift::controller {
namespace {

constexpr std::size_t header_bytes = 7;  // MBAP: transaction, protocol, length, unit
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

void append_word(std::vector<std::uint8_t>& bytes, int word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8 & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(word & 0xFF));
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
    return wire;
  }
  ~Wire() {
    if (m_context == nullptr) return;
    modbus_close(m_context);  // modbus_free does not close the socket
    modbus_free(m_context);
  }
  Wire(const Wire&) = delete;
  Wire& operator=(const Wire&) = delete;

  /// Bytes that nobody asked for, or the peer's end of the connection: this wire cannot be trusted any more.
  bool stale() const {
    if (!m_tcp) {
      modbus_flush(m_context);
      return false;
    }
    std::uint8_t byte = 0;
    const auto got = ::recv(modbus_get_socket(m_context), &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return got >= 0 || (errno != EAGAIN && errno != EWOULDBLOCK);
  }

  Status send(const std::vector<std::uint8_t>& pdu, const std::string& what) {
    std::vector<std::uint8_t> frame;
    if (m_tcp) {
      m_transaction = (m_transaction + 1) & 0xFFFF;
      append_word(frame, m_transaction);
      append_word(frame, 0);
      append_word(frame, static_cast<int>(pdu.size()) + 1);
    }
    frame.push_back(static_cast<std::uint8_t>(m_settings.unit));
    frame.insert(frame.end(), pdu.begin(), pdu.end());
    if (!m_tcp) {  // adds the CRC
      const int sent = modbus_send_raw_request(m_context, frame.data(), static_cast<int>(frame.size()));
      if (sent < 0) return fail(from_errno(errno, what, m_settings.timeout_ms));
      return {};
    }
    const auto sent = ::send(modbus_get_socket(m_context), frame.data(), frame.size(), MSG_NOSIGNAL);
    if (sent < 0) return fail(from_errno(errno, what, m_settings.timeout_ms));
    if (sent != static_cast<ssize_t>(frame.size())) return fail(from_errno(EPIPE, what, m_settings.timeout_ms));
    return {};
  }

  Result<std::vector<std::uint8_t>> receive(const std::string& what) {
    std::array<std::uint8_t, MODBUS_TCP_MAX_ADU_LENGTH> buffer{};
    const int got = modbus_receive_confirmation(m_context, buffer.data());
    if (got < 0) return fail(from_errno(errno, what, m_settings.timeout_ms));
    return checked(std::span(buffer).first(static_cast<std::size_t>(got)), what);
  }

 private:
  explicit Wire(const ControllerSettings& settings)
      : m_settings(settings),
        m_tcp(settings.kind == LinkKind::tcp),
        m_context(
            m_tcp ? modbus_new_tcp_pi(settings.host.c_str(), std::to_string(settings.port).c_str())
                  : modbus_new_rtu(settings.device.c_str(), settings.baud, settings.parity, 8, settings.stop_bits)) {}

  /// The reply without its envelope, if the envelope is right.
  Result<std::vector<std::uint8_t>> checked(std::span<const std::uint8_t> frame, const std::string& what) const {
    const std::size_t lead = m_tcp ? header_bytes : 1;
    const std::size_t trail = m_tcp ? 0 : 2;  // CRC, checked by the library
    if (frame.size() < lead + trail + 2) return fail(bad_reply(what, fmt::format("{} bytes only", frame.size())));
    if (m_tcp) {
      const int transaction = word_at(frame, 0);
      if (transaction != m_transaction) {
        return fail(bad_reply(what, fmt::format("transaction {} instead of {}", transaction, m_transaction)));
      }
      if (word_at(frame, 2) != 0) return fail(bad_reply(what, fmt::format("protocol {}", word_at(frame, 2))));
      const int length = word_at(frame, 4);
      if (length + 6 != static_cast<int>(frame.size())) {
        return fail(bad_reply(what, fmt::format("length {} for {} bytes", length, frame.size() - 6)));
      }
    }
    const int unit = frame[lead - 1];
    if (unit != m_settings.unit) return fail(bad_reply(what, fmt::format("unit {}, not {}", unit, m_settings.unit)));
    const auto pdu = frame.subspan(lead, frame.size() - lead - trail);
    return std::vector<std::uint8_t>(pdu.begin(), pdu.end());
  }

  ControllerSettings m_settings;
  bool m_tcp;
  modbus_t* m_context;
  int m_transaction = 0;
};

Link::Link(ControllerSettings settings) : m_settings(std::move(settings)) {}
Link::~Link() = default;

void Link::close() {
  m_wire.reset();
}

Result<Link::Pdu> Link::exchange_once(const Pdu& request, const std::string& what) {
  if (m_wire && m_wire->stale()) m_wire.reset();
  if (!m_wire) {
    ZD_TRY(m_wire, Wire::open(m_settings));
    if (m_was_connected) ++m_health.reconnects;
    m_was_connected = true;
  }
  ++m_health.requests;
  ZD_CHECK(m_wire->send(request, what));
  ZD_TRY(Pdu reply, m_wire->receive(what));
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
    auto reply = exchange_once(request, what);
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
  Pdu request{static_cast<std::uint8_t>(space == RegisterSpace::holding ? 3 : 4)};
  append_word(request, address);
  append_word(request, count);
  for (int attempt = 0;; ++attempt) {
    ZD_TRY(const Pdu reply, exchange(request, what, Retry::yes));
    const auto bytes = static_cast<std::size_t>(2 * count);
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
  Pdu request{static_cast<std::uint8_t>(words.size() == 1 ? 6 : 16)};
  append_word(request, address);
  if (words.size() > 1) {
    append_word(request, static_cast<int>(words.size()));
    request.push_back(static_cast<std::uint8_t>(2 * words.size()));
  }
  for (const std::uint16_t word : words) append_word(request, word);
  ZD_TRY(const Pdu reply, exchange(request, what, retry));
  // Function 16 echoes address and count. Function 6 echoes address and value, but a register that clears itself is
  // answered with its new value by some devices, so there only the address must agree.
  const std::ptrdiff_t echoed = words.size() == 1 ? 3 : 5;
  if (reply.size() != 5 || !std::equal(reply.begin() + 1, reply.begin() + echoed, request.begin() + 1)) {
    ++m_health.faults[std::string(name_of(ErrorCode::machine_bad_reply))];
    m_wire.reset();
    return fail(bad_reply(what, "echo of a write differs"));
  }
  return {};
}

}  // namespace zerodrift::controller
