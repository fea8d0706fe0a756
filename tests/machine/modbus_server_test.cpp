#include "core/controller/modbus_server.h"

#include <gtest/gtest.h>

#include <atomic>
#include <map>
#include <mutex>
#include <thread>

#include "tests/machine/raw_modbus.h"

namespace zerodrift::controller {
namespace {

using Kind = ReplyFault::Kind;
using testing::RawModbus;

/// A device with 1000 registers behind the server.
class Device {
 public:
  explicit Device(ReplyFault fault = {}) {
    ModbusServerOptions options;
    options.read = [this](int address, int count) -> RegisterReply {
      const std::scoped_lock lock(m_mutex);
      if (address + count > 1000) return tl::unexpected(ModbusException::illegal_address);
      return std::vector<std::uint16_t>(m_words.begin() + address, m_words.begin() + address + count);
    };
    options.write = [this](int address, std::span<const std::uint16_t> words) -> std::optional<ModbusException> {
      const std::scoped_lock lock(m_mutex);
      if (address == 7) return ModbusException::device_failure;
      if (address + words.size() > 1000) return ModbusException::illegal_address;
      std::copy(words.begin(), words.end(), m_words.begin() + address);
      ++m_writes;
      return std::nullopt;
    };
    options.fault = [fault](bool) { return fault; };
    m_server = std::move(*ModbusServer::start(std::move(options)));
  }
  int port() const { return m_server->port(); }
  int writes() {
    const std::scoped_lock lock(m_mutex);
    return m_writes;
  }

 private:
  std::mutex m_mutex;
  std::vector<std::uint16_t> m_words = std::vector<std::uint16_t>(1000, 0);
  int m_writes = 0;
  std::unique_ptr<ModbusServer> m_server;
};

TEST(ModbusServer, ReadsWhatWasWritten) {
  Device device;
  RawModbus client(device.port());
  EXPECT_EQ(client.write(100, {1, 2, 0xFFFF}), 0);
  EXPECT_EQ(client.write_one(103, 77), 0);
  EXPECT_EQ(client.read(100, 4), (std::vector<std::uint16_t>{1, 2, 0xFFFF, 77}));
}

TEST(ModbusServer, TakesTheLargestRequestsAndRefusesTheNext) {
  Device device;
  RawModbus client(device.port());
  EXPECT_EQ(client.write(0, std::vector<std::uint16_t>(7, 1)), 0);
  EXPECT_EQ(client.write(100, std::vector<std::uint16_t>(123, 5)), 0);
  EXPECT_EQ(client.read(100, 125).size(), 125U);
  EXPECT_EQ(client.write(100, std::vector<std::uint16_t>(124, 5)), 3);
  EXPECT_EQ(client.read_exception(100, 126), 3);
  EXPECT_EQ(client.read_exception(100, 0), 3);
  EXPECT_EQ(client.read(100, 1).size(), 1U) << "the connection must survive a refusal";
}

TEST(ModbusServer, PassesExceptionsOn) {
  Device device;
  RawModbus client(device.port());
  EXPECT_EQ(client.read_exception(999, 2), 2);
  EXPECT_EQ(client.write(7, {1}), 4);
  EXPECT_EQ(client.request({4, 0, 0, 0, 1}).exception(), 1) << "input registers are not served";
  EXPECT_EQ(client.request({3, 0, 0, 0, 1}, 3000, 9).exception(), 11) << "another unit";
  EXPECT_EQ(client.request({16, 0, 0, 0, 2, 3, 0, 1, 0}).exception(), 3) << "byte count does not fit";
}

TEST(ModbusServer, ServesSeveralClientsAtOnce) {
  Device device;
  std::atomic<int> wrong{0};
  std::vector<std::jthread> clients;
  for (int k = 0; k < 6; ++k) {
    clients.emplace_back([&, k] {
      RawModbus client(device.port());
      for (std::uint16_t i = 0; i < 200; ++i) {
        client.write(100 + 10 * k, {i, static_cast<std::uint16_t>(k)});
        if (client.read(100 + 10 * k, 2) != std::vector<std::uint16_t>{i, static_cast<std::uint16_t>(k)}) ++wrong;
      }
    });
  }
  clients.clear();
  EXPECT_EQ(wrong, 0);
}

TEST(ModbusServer, SaysWhenThePortIsTaken) {
  Device device;
  ModbusServerOptions options;
  options.port = device.port();
  const auto second = ModbusServer::start(std::move(options));
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, ErrorCode::port_unavailable);
}

TEST(ModbusServerFaults, BusyDoesNotCarryOutTheRequest) {
  Device device({Kind::busy, {}});
  RawModbus client(device.port());
  EXPECT_EQ(client.write(100, {1}), 6);
  EXPECT_EQ(device.writes(), 0);
}

TEST(ModbusServerFaults, LateRepliesAreWhole) {
  Device device({Kind::late, std::chrono::milliseconds(200)});
  RawModbus client(device.port());
  const auto reply = client.request({3, 0, 0, 0, 2});
  EXPECT_TRUE(reply.whole);
  EXPECT_GE(reply.milliseconds, 190);
}

TEST(ModbusServerFaults, WrongTransactionIsAllThatIsWrong) {
  Device device({Kind::wrong_transaction, {}});
  RawModbus client(device.port());
  const auto reply = client.request({3, 0, 0, 0, 2});
  EXPECT_TRUE(reply.whole);
  EXPECT_FALSE(reply.same_transaction);
}

TEST(ModbusServerFaults, TruncatedRepliesNeverEnd) {
  Device device({Kind::truncated, {}});
  RawModbus client(device.port());
  const auto reply = client.request({3, 0, 0, 0, 20}, 300);
  EXPECT_FALSE(reply.whole);
  EXPECT_FALSE(reply.closed);
}

TEST(ModbusServerFaults, DropClosesTheConnection) {
  Device device({Kind::drop, {}});
  RawModbus client(device.port());
  EXPECT_TRUE(client.request({3, 0, 0, 0, 20}, 1000).closed);
}

TEST(ModbusServerFaults, BytewiseRepliesAreRight) {
  Device device({Kind::bytewise, std::chrono::milliseconds(2)});
  RawModbus client(device.port());
  const auto reply = client.request({3, 0, 0, 0, 3});
  EXPECT_TRUE(reply.whole);
  EXPECT_GT(reply.packets, 5);
  EXPECT_EQ(reply.pdu.size(), 8U);
}

}  // namespace
}  // namespace zerodrift::controller
