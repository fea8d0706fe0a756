#include "tests/machine/raw_modbus.h"

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>

namespace zerodrift::testing {
namespace {

void put(std::vector<std::uint8_t>& bytes, int word) {
  bytes.push_back(static_cast<std::uint8_t>(word >> 8));
  bytes.push_back(static_cast<std::uint8_t>(word));
}

}  // namespace

RawModbus::RawModbus(int port) : m_socket(::socket(AF_INET, SOCK_STREAM, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(m_socket, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) {
    throw std::runtime_error("no connection to port " + std::to_string(port));
  }
}

RawModbus::~RawModbus() {
  ::close(m_socket);
}

RawModbus::Reply RawModbus::request(const std::vector<std::uint8_t>& pdu, int timeout_ms, int unit) {
  std::vector<std::uint8_t> frame;
  put(frame, ++m_transaction);
  put(frame, 0);
  put(frame, static_cast<int>(pdu.size()) + 1);
  frame.push_back(static_cast<std::uint8_t>(unit));
  frame.insert(frame.end(), pdu.begin(), pdu.end());
  Reply reply;
  if (::send(m_socket, frame.data(), frame.size(), MSG_NOSIGNAL) < 0) {
    reply.closed = true;
    return reply;
  }
  const auto begin = std::chrono::steady_clock::now();
  const auto elapsed = [&] {
    return static_cast<int>(
        std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - begin).count());
  };
  std::vector<std::uint8_t> got;
  const auto complete = [&] {
    return got.size() >= 6 && got.size() >= 6U + static_cast<unsigned>(got[4] << 8 | got[5]);
  };
  while (!complete() && elapsed() < timeout_ms) {
    pollfd wait{m_socket, POLLIN, 0};
    if (::poll(&wait, 1, timeout_ms - elapsed()) <= 0) break;
    std::array<std::uint8_t, 600> buffer{};
    const auto count = ::recv(m_socket, buffer.data(), buffer.size(), 0);
    if (count <= 0) {
      reply.closed = true;
      break;
    }
    ++reply.packets;
    got.insert(got.end(), buffer.begin(), buffer.begin() + count);
  }
  reply.milliseconds = elapsed();
  reply.whole = complete();
  if (!reply.whole) return reply;
  reply.same_transaction = (got[0] << 8 | got[1]) == m_transaction;
  reply.pdu.assign(got.begin() + 7, got.end());
  return reply;
}

std::vector<std::uint16_t> RawModbus::read(int address, int count) {
  std::vector<std::uint8_t> pdu{3};
  put(pdu, address);
  put(pdu, count);
  const Reply reply = request(pdu);
  std::vector<std::uint16_t> words;
  if (!reply.whole || reply.exception() != 0) return words;
  for (std::size_t i = 2; i + 1 < reply.pdu.size(); i += 2) {
    words.push_back(static_cast<std::uint16_t>(reply.pdu[i] << 8 | reply.pdu[i + 1]));
  }
  return words;
}

int RawModbus::read_exception(int address, int count) {
  std::vector<std::uint8_t> pdu{3};
  put(pdu, address);
  put(pdu, count);
  return request(pdu).exception();
}

int RawModbus::write(int address, const std::vector<std::uint16_t>& words) {
  std::vector<std::uint8_t> pdu{16};
  put(pdu, address);
  put(pdu, static_cast<int>(words.size()));
  pdu.push_back(static_cast<std::uint8_t>(words.size() * 2));
  for (const std::uint16_t word : words) put(pdu, word);
  const Reply reply = request(pdu);
  return reply.whole ? reply.exception() : -1;
}

int RawModbus::write_one(int address, std::uint16_t word) {
  std::vector<std::uint8_t> pdu{6};
  put(pdu, address);
  put(pdu, word);
  const Reply reply = request(pdu);
  return reply.whole ? reply.exception() : -1;
}

}  // namespace zerodrift::testing
