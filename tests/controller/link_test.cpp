// The link against devices, gateways and lines as they are found in workshops.

#include "core/controller/link.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <random>

#include "core/acquisition/machine_fault.h"
#include "core/controller/modbus_machine.h"
#include "core/controller/rtu_reply.h"
#include "fake_controller.h"
#include "serial_device.h"

namespace zerodrift::controller {
namespace {

using Kind = ReplyFault::Kind;

bool remarked(const LinkHealth& health, const std::string& part) {
  return std::any_of(health.remarks.begin(), health.remarks.end(),
                     [&](const std::string& remark) { return remark.find(part) != std::string::npos; });
}

Result<std::vector<std::uint16_t>> read_some(Link& link, int address = 100, int count = 4) {
  return link.read(RegisterSpace::holding, address, count, "some registers");
}

Status write_some(Link& link, int address, std::vector<std::uint16_t> words) {
  return link.write(address, words, "some registers");
}

}  // namespace

TEST(MachineFault, OnlyWhatMayPassIsTriedAgain) {
  using acquisition::may_pass;
  for (const auto code :
       {ErrorCode::machine_unreachable, ErrorCode::machine_silent, ErrorCode::machine_link_lost,
        ErrorCode::machine_bad_reply, ErrorCode::machine_busy, ErrorCode::machine_gateway, ErrorCode::machine_failed}) {
    EXPECT_TRUE(may_pass({code, {}})) << name_of(code);
  }
  for (const auto code :
       {ErrorCode::machine_exception, ErrorCode::machine_function_missing, ErrorCode::machine_unsupported,
        ErrorCode::machine_not_ready, ErrorCode::access_locked, ErrorCode::limit_exceeded, ErrorCode::cancelled}) {
    EXPECT_FALSE(may_pass({code, {}})) << name_of(code);
  }
}

class ExceptionOnce : public testing::TestWithParam<int> {};

// A gateway or a busy device answers one request with an exception; the next try succeeds.
TEST_P(ExceptionOnce, IsOvercomeByReadsAndWrites) {
  FakeController device;
  Link link(device.profile().controller);
  const auto exception = static_cast<ModbusException>(GetParam());
  const bool passes = GetParam() >= 4;
  for (const auto kind : {Kind::refused, Kind::refused_after}) {
    device.spoil(0, {kind, std::chrono::milliseconds(0), exception});
    EXPECT_EQ(read_some(link).has_value(), passes);
    device.spoil(0, {kind, std::chrono::milliseconds(0), exception});
    EXPECT_EQ(write_some(link, 72, {7, 8}).has_value(), passes);
    if (passes) {
      EXPECT_EQ(device.word(73), 8);
    }
    // A write that must not be repeated is not: whoever sent it asks what became of it.
    device.spoil(0, {kind, std::chrono::milliseconds(0), exception});
    const std::vector<std::uint16_t> words{1};
    EXPECT_FALSE(link.write(74, words, "once", Retry::no));
    EXPECT_EQ(device.requests(), 1);
  }
  EXPECT_EQ(link.health().reconnects, 0) << "a whole reply is no reason to leave the connection";
}

INSTANTIATE_TEST_SUITE_P(Codes, ExceptionOnce, testing::Values(2, 3, 4, 5, 6, 10, 11));

TEST(Link, AnExceptionThatStaysIsNamed) {
  FakeController device;
  Link link(device.profile().controller);
  const auto named = [&](int code) {
    device.spoil(0, {Kind::refused, std::chrono::milliseconds(0), static_cast<ModbusException>(code)}, true);
    return read_some(link).error().code;
  };
  EXPECT_EQ(named(2), ErrorCode::machine_exception);
  EXPECT_EQ(named(4), ErrorCode::machine_failed);
  EXPECT_EQ(named(5), ErrorCode::machine_busy);
  EXPECT_EQ(named(6), ErrorCode::machine_busy);
  EXPECT_EQ(named(10), ErrorCode::machine_gateway);
  EXPECT_EQ(named(11), ErrorCode::machine_gateway);
}

TEST(Link, ADeviceWithoutFunction6IsWrittenWithFunction16) {
  FakeController device({6});
  Link link(device.profile().controller);
  ASSERT_TRUE(write_some(link, 72, {4711}));
  EXPECT_EQ(device.word(72), 4711);
  EXPECT_TRUE(remarked(link.health(), "no function 6"));
  device.spoil(-1, {});
  ASSERT_TRUE(write_some(link, 72, {4712}));
  EXPECT_EQ(device.requests(), 1) << "known by now";
  EXPECT_EQ(device.word(72), 4712);
  EXPECT_EQ(link.health().remarks.size(), 1U);
}

TEST(Link, WhatFunctionADeviceLacksIsNamed) {
  FakeController no_16({16});
  Link link(no_16.profile().controller);
  EXPECT_TRUE(write_some(link, 72, {1}));
  const Status two = write_some(link, 72, {1, 2});
  ASSERT_FALSE(two);
  EXPECT_EQ(two.error().code, ErrorCode::machine_function_missing);
  EXPECT_NE(two.error().context.at("function").find("16"), std::string::npos);
  FakeController read_only({6, 16});
  Link other(read_only.profile().controller);
  const Status one = write_some(other, 72, {1});
  ASSERT_FALSE(one);
  EXPECT_EQ(one.error().context.at("function"), "6 or 16 (write registers)");
  FakeController mute({3});
  Link third(mute.profile().controller);
  EXPECT_EQ(read_some(third).error().code, ErrorCode::machine_function_missing);
}

TEST(Link, AFunctionThatWorkedIsNotCalledMissing) {
  FakeController device;
  Link link(device.profile().controller);
  ASSERT_TRUE(read_some(link));
  ASSERT_TRUE(write_some(link, 72, {1}));
  for (const bool writes : {false, true}) {
    device.spoil(0, {Kind::refused, std::chrono::milliseconds(0), ModbusException::illegal_function});
    const auto refused = writes ? write_some(link, 72, {2}) : read_some(link).map([](const auto&) {});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::machine_exception);
    EXPECT_EQ(refused.error().context.at("exception"), "1");
  }
  EXPECT_TRUE(link.health().remarks.empty());
}

TEST(Link, AReplyOfAnotherUnitIsRefusedByName) {
  FakeController device;
  device.set(100, 1234);
  Link link(device.profile().controller);
  device.spoil(0, {Kind::wrong_unit, {}}, true);
  const auto refused = read_some(link);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::machine_bad_reply);
  EXPECT_EQ(refused.error().context.at("detail"), "unit 2, not 1");
  device.spoil(0, {Kind::wrong_unit, {}});
  const auto again = read_some(link);
  ASSERT_TRUE(again) << describe(again.error());
  EXPECT_EQ(again->front(), 1234);
}

TEST(ModbusMachine, SwitchesOnceWhenTheAnswerIsUnclear) {
  for (const auto kind : {Kind::truncated, Kind::drop, Kind::refused_after}) {
    FakeController device;
    std::atomic<int> commands = 0;
    device.on_write = [&](int address, std::span<const std::uint16_t>) -> std::optional<ModbusException> {
      commands += address == 76 ? 1 : 0;
      return std::nullopt;
    };
    auto machine = ModbusMachine::open(device.profile(), engineer());
    ASSERT_TRUE(machine);
    // A dropped request is not carried out: it is commanded a second time after the switch was asked.
    device.spoil(0, {kind, {}, ModbusException::gateway_target_silent});
    const Status done = (*machine)->switch_compensation(true);
    ASSERT_TRUE(done) << describe(done.error());
    EXPECT_EQ(device.word(17), 1);
    EXPECT_EQ(commands, 1) << static_cast<int>(kind);
  }
}

TEST(ModbusMachine, ClearsTheOffsetWhileTheSwitchIsOff) {
  FakeController device;
  device.set_float(144, -8.0);
  auto machine = ModbusMachine::open(device.profile(), engineer());
  ASSERT_TRUE(machine);
  ASSERT_TRUE((*machine)->clear_host_offset());
  EXPECT_DOUBLE_EQ(device.float_at(144), 0.0);
  EXPECT_EQ((*machine)->write_values("host_offset_um", {1.0, 2.0, 3.0, 4.0}).error().code,
            ErrorCode::machine_unsupported);
}

// A device that reads fewer registers a request than the standard allows.
TEST(ModbusMachine, ReadsInShorterPartsWhereLongOnesAreRefused) {
  FakeController device;
  device.set(100, 16 * 30);
  device.set_float(24, -12.5);
  device.limit_reads(5);
  auto machine = ModbusMachine::open(device.profile());
  ASSERT_TRUE(machine);
  const auto sample = (*machine)->read();
  ASSERT_TRUE(sample) << describe(sample.error());
  EXPECT_DOUBLE_EQ(sample->temperature_C.front(), 30.0);
  EXPECT_DOUBLE_EQ(sample->axes.at("Z"), -12.5);
}

// A host whose queue is full: it neither refuses nor answers.
TEST(Link, SaysThatNoConnectionCameInTime) {
  const int listener = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(::bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(::listen(listener, 0), 0);
  ASSERT_EQ(::getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
  std::array<int, 4> waiting{};
  for (int& one : waiting) {
    one = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
    static_cast<void>(::connect(one, reinterpret_cast<sockaddr*>(&address), size));
  }
  ControllerSettings settings;
  settings.port = ntohs(address.sin_port);
  settings.timeout_ms = 100;
  Link link(settings);
  link.set_attempts(1);
  const auto words = read_some(link);
  ASSERT_FALSE(words);
  EXPECT_EQ(words.error().code, ErrorCode::machine_unreachable);
  EXPECT_EQ(words.error().context.at("detail"), "no answer within 100 ms");
  for (const int one : waiting) ::close(one);
  ::close(listener);
}

class SerialLine : public testing::TestWithParam<SerialHabits> {};

// Zero bytes before a reply, and the adapter's own echo: the replies are found, and it is said once.
TEST_P(SerialLine, IsReadAndWritten) {
  SerialDevice device(GetParam());
  for (int i = 0; i < 4; ++i) device.set(100 + i, static_cast<std::uint16_t>(10 * i));
  Link link(device.settings());
  for (int i = 0; i < 3; ++i) {
    const auto words = read_some(link);
    ASSERT_TRUE(words) << describe(words.error());
    EXPECT_EQ(*words, (std::vector<std::uint16_t>{0, 10, 20, 30}));
    const Status one = write_some(link, 200, {static_cast<std::uint16_t>(7 + i)});
    ASSERT_TRUE(one) << describe(one.error());
    EXPECT_EQ(device.word(200), 7 + i);
    const Status two = write_some(link, 300, {1, 2, 3});
    ASSERT_TRUE(two) << describe(two.error());
    EXPECT_EQ(device.word(302), 3);
    EXPECT_EQ(read_some(link, 5999, 2).error().code, ErrorCode::machine_exception);
  }
  EXPECT_TRUE(link.health().faults.empty());
  EXPECT_EQ(remarked(link.health(), "local echo"), GetParam().echo);
  // On a busy computer a zero after one reply may come so late that it is one before the next.
  if (GetParam().zeros_after == 0) {
    EXPECT_EQ(remarked(link.health(), "zero bytes"), GetParam().zeros_before > 0);
  }
  EXPECT_LE(link.health().remarks.size(), 2U);
}

// The reply to function 6 is the request once more: its echo alone must not be taken for it.
TEST_P(SerialLine, AWriteThatComesFirstIsNotTakenForDoneByItsEcho) {
  SerialDevice device(GetParam());
  Link link(device.settings());
  const Status done = write_some(link, 200, {77});
  ASSERT_TRUE(done) << describe(done.error());
  EXPECT_EQ(device.word(200), 77);
  EXPECT_EQ(device.functions(), (std::vector<int>{3, 6})) << "a read tells whether there is an echo";
}

INSTANTIATE_TEST_SUITE_P(Habits, SerialLine,
                         testing::Values(SerialHabits{}, SerialHabits{.echo = true}, SerialHabits{.zeros_before = 1},
                                         SerialHabits{.echo = true, .zeros_before = 2}, SerialHabits{.zeros_after = 1}),
                         [](const auto& habits) {
                           const std::string echo = habits.param.echo ? "Echo" : "NoEcho";
                           return echo + "Zeros" + std::to_string(habits.param.zeros_before) + "Before" +
                                  std::to_string(habits.param.zeros_after) + "After";
                         });

// Behind an echo there is nobody: silence, and no write taken for done.
TEST(SerialLine, AnEchoAloneIsSilence) {
  SerialDevice device(
      {.echo = true, .delay = [](int request) { return std::chrono::milliseconds(request > 0 ? 600 : 0); }});
  Link link(device.settings());
  link.set_attempts(1);
  ASSERT_TRUE(read_some(link));
  const auto late = write_some(link, 200, {5});
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::machine_silent);
}

TEST(SerialLine, AReplyOfAnotherUnitIsRefusedByName) {
  SerialDevice device({.unit = 3});
  Link link(device.settings());
  link.set_attempts(1);
  const auto refused = read_some(link);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().context.at("detail"), "unit 3, not 1");
}

// RTU has no transaction: what comes late must not answer the next question of the same length.
TEST(SerialLine, ALateReplyIsNotMixedWithTheNext) {
  SerialDevice device({.delay = [](int request) { return std::chrono::milliseconds(request == 1 ? 300 : 0); }});
  device.set(100, 1);
  device.set(110, 2);
  Link link(device.settings());
  link.set_attempts(1);
  ASSERT_TRUE(read_some(link, 100, 1));
  EXPECT_EQ(read_some(link, 100, 1).error().code, ErrorCode::machine_silent);
  const auto other = read_some(link, 110, 1);
  ASSERT_TRUE(other) << describe(other.error());
  EXPECT_EQ(other->front(), 2);
}

// Noise is no reply: whatever comes is refused, or waited for, unless its check sum fits.
TEST(SerialLine, NoiseIsNoReply) {
  std::mt19937 random(5);
  std::vector<std::uint8_t> request{1, 3, 0, 100, 0, 4};
  append_rtu_crc(request);
  int spoilt = 0;
  for (int i = 0; i < 20000; ++i) {
    RtuReply reply(request, i % 2 == 0 ? LocalEcho::unknown : LocalEcho::heard);
    std::vector<std::uint8_t> bytes(random() % 40);
    for (auto& byte : bytes) byte = static_cast<std::uint8_t>(random());
    if (bytes.size() > 3 && i % 3 == 0) std::copy_n(std::array<std::uint8_t, 3>{1, 3, 8}.begin(), 3, bytes.begin());
    const auto state = reply.add(bytes);
    spoilt += state == RtuReply::State::spoilt ? 1 : 0;
    if (state != RtuReply::State::whole) continue;
    std::vector<std::uint8_t> whole(reply.frame().begin(), reply.frame().end());
    append_rtu_crc(whole);
    EXPECT_NE(std::search(bytes.begin(), bytes.end(), whole.begin(), whole.end()), bytes.end());
  }
  EXPECT_GT(spoilt, 1000);
}

TEST(SerialLine, CheckSumIsThatOfTheStandard) {
  // The request of the example in Modbus over serial line V1.02, appendix B: CRC 0x1241, low byte first.
  EXPECT_EQ(rtu_crc(std::vector<std::uint8_t>{0x02, 0x07}), 0x1241);
}

}  // namespace zerodrift::controller
