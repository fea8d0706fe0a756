// The machine behind the register map, against a Modbus stack that is not ours and against a device with faults.

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <mutex>
#include <thread>

#include "core/controller/modbus_machine.h"
#include "core/controller/modbus_server.h"
#include "fake_controller.h"
#include "peer.h"

namespace zerodrift::controller {
namespace {

using Kind = ReplyFault::Kind;

/// A register bank behind the server whose replies can be spoilt.
struct Bank {
  std::mutex lock;
  std::vector<std::uint16_t> words = std::vector<std::uint16_t>(6000, 0);
  std::atomic<int> every{0};  // every n-th reply is spoilt
  std::atomic<int> answered{0};
  ReplyFault fault;
  std::unique_ptr<ModbusServer> server;

  void start() {
    words[0] = 0x5A44;
    words[1] = 1;
    words[2] = 15;
    words[3] = 2000;
    words[6] = 20;
    words[16] = 4;
    words[100] = 16 * 25;
    words[101] = 0x8000;
    ModbusServerOptions options;
    options.read = [this](int address, int count) -> RegisterReply {
      const std::scoped_lock guard(lock);
      if (address + count > 6000) return tl::unexpected(ModbusException::illegal_address);
      return std::vector<std::uint16_t>(words.begin() + address, words.begin() + address + count);
    };
    options.write = [this](int address, std::span<const std::uint16_t> values) -> std::optional<ModbusException> {
      const std::scoped_lock guard(lock);
      if (address + values.size() > 6000) return ModbusException::illegal_address;
      std::copy(values.begin(), values.end(), words.begin() + address);
      if (address == 76) words[17] = values[0];
      if (address == 70) words[70] = 0;
      return std::nullopt;
    };
    options.fault = [this](bool) {
      const int n = ++answered;
      return every > 0 && n % every == 0 ? fault : ReplyFault{};
    };
    auto started = ModbusServer::start(std::move(options));
    ASSERT_TRUE(started) << describe(started.error());
    server = std::move(*started);
  }
  Profile profile() const {
    Profile p;
    p.controller.port = server->port();
    p.controller.timeout_ms = 150;
    p.sensors = {{"T1_C", "", "", {}, 0.1}, {"T2_C", "", "", {}, 0.1}};
    return p;
  }
};

}  // namespace

TEST(ModbusMachine, SamplesAPymodbusPeer) {
  const Peer peer({"--speedup", "60"});
  if (!peer.running()) GTEST_SKIP() << "python3-pymodbus is not installed";
  const auto profile = read_profile(peer.profile_file());
  ASSERT_TRUE(profile) << describe(profile.error());
  auto machine = ModbusMachine::open(*profile, engineer());
  ASSERT_TRUE(machine) << describe(machine.error());
  const auto identity = (*machine)->identify();
  ASSERT_TRUE(identity) << describe(identity.error());
  EXPECT_EQ(identity->serial, 4711U);
  EXPECT_EQ(identity->sensors.size(), 20U);
  EXPECT_EQ(identity->table_capacity_registers, 2000);
  EXPECT_TRUE(identity->accepts_table && identity->accepts_host_offset && identity->has_probes);

  ASSERT_TRUE((*machine)->command(3000.0, true, true));
  ASSERT_TRUE((*machine)->move_to({{"X", 120.0}, {"Z", -5.5}}));
  const auto sample = (*machine)->read();
  ASSERT_TRUE(sample) << describe(sample.error());
  EXPECT_DOUBLE_EQ(sample->axes.at("X"), 120.0);
  EXPECT_DOUBLE_EQ(sample->axes.at("Y"), 0.0);
  EXPECT_DOUBLE_EQ(sample->axes.at("Z"), -5.5);
  EXPECT_EQ(sample->temperature_C.size(), 20U);
  EXPECT_NEAR(sample->temperature_C[0], 20.0, 3.0);
  EXPECT_TRUE(sample->coolant_on);
  EXPECT_FALSE(sample->probes_um.has_value());  // not at the nest
  ASSERT_TRUE((*machine)->move_to({{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}}));
  EXPECT_TRUE((*machine)->read()->probes_um.has_value());
  EXPECT_EQ((*machine)->write_host_offset({1.0, 0.0, 0.0}).error().code, ErrorCode::interlock_compensation_off);
  ASSERT_TRUE((*machine)->switch_compensation(true));
  EXPECT_TRUE((*machine)->write_host_offset({1.0, -2.0, 3.0}));
  EXPECT_EQ((*machine)->write_host_offset({201.0, 0.0, 0.0}).error().code, ErrorCode::limit_exceeded);
}

TEST(ModbusMachine, SplitsReadsForADeviceThatRefusesGaps) {
  const Peer peer({"--strict"});
  if (!peer.running()) GTEST_SKIP() << "python3-pymodbus is not installed";
  auto machine = ModbusMachine::open(*read_profile(peer.profile_file()));
  ASSERT_TRUE(machine);
  const auto sample = (*machine)->read();
  ASSERT_TRUE(sample) << describe(sample.error());
  EXPECT_NEAR(sample->temperature_C[19], 20.0, 3.0);
  EXPECT_TRUE(sample->referenced);
}

TEST(ModbusMachine, SampleTakesTwoRequests) {
  Bank bank;
  bank.start();
  auto machine = ModbusMachine::open(bank.profile(), engineer());
  ASSERT_TRUE(machine);
  const auto sample = (*machine)->read();
  ASSERT_TRUE(sample) << describe(sample.error());
  EXPECT_EQ((*machine)->health().requests, 2);
  EXPECT_DOUBLE_EQ(sample->temperature_C[0], 25.0);
  EXPECT_TRUE(std::isnan(sample->temperature_C[1]));  // broken wire
}

/// The ramp is told as over while the machine still runs after what the table asks for, at the rate it is limited to.
TEST(ModbusMachine, WaitsForWhatIsAppliedAndNotForTheRampAlone) {
  constexpr double last_um = -24.0;
  constexpr int applied_Z = 44;
  FakeController device;
  device.set(213, 100);
  Profile profile = device.profile();
  profile.time_factor = 10.0;
  auto machine = ModbusMachine::open(profile, engineer());
  ASSERT_TRUE(machine);
  std::jthread moving([&device] {
    for (double um = 0.0; um >= last_um; um -= 0.5) {
      device.set_float(applied_Z, um);
      std::this_thread::sleep_for(std::chrono::milliseconds(25));
    }
  });
  ASSERT_TRUE((*machine)->wait_for_ramp(true));
  EXPECT_DOUBLE_EQ(device.float_at(applied_Z), last_um);
  std::stop_source stop;
  stop.request_stop();
  EXPECT_EQ((*machine)->wait_for_ramp(true, stop.get_token()).error().code, ErrorCode::cancelled);
}

class SporadicFault : public testing::TestWithParam<std::pair<Kind, const char*>> {};

TEST_P(SporadicFault, IsOvercomeAndCounted) {
  Bank bank;
  bank.fault = {GetParam().first, std::chrono::milliseconds(GetParam().first == Kind::late ? 250 : 0),
                ModbusException::gateway_target_silent};
  bank.start();
  bank.every = 4;
  auto machine = ModbusMachine::open(bank.profile(), engineer());
  ASSERT_TRUE(machine);
  for (int i = 0; i < 12; ++i) {
    const auto sample = (*machine)->read();
    ASSERT_TRUE(sample) << describe(sample.error());
    ASSERT_DOUBLE_EQ(sample->temperature_C[0], 25.0);
  }
  EXPECT_TRUE((*machine)->switch_compensation(true));
  EXPECT_TRUE((*machine)->write_host_offset({5.0, 0.0, 0.0}));
  const auto& faults = (*machine)->health().faults;
  if (GetParam().first == Kind::bytewise) {
    // Slow, but a whole reply in time. On a busy computer the bytes come so far apart that they are told as pieces.
    for (const auto& [name, count] : faults) EXPECT_EQ(name, "reply_in_pieces");
  } else {
    EXPECT_GT(faults.at(GetParam().second), 0) << "counted under another name";
    EXPECT_EQ(faults.size(), 1U);
  }
}

TEST_P(SporadicFault, WithoutEndIsNamed) {
  Bank bank;
  bank.fault = {GetParam().first, std::chrono::milliseconds(GetParam().first == Kind::late ? 250 : 20),
                ModbusException::gateway_path_unavailable};
  bank.start();
  bank.every = 1;
  auto machine = ModbusMachine::open(bank.profile(), engineer());
  ASSERT_TRUE(machine);
  const auto start = std::chrono::steady_clock::now();
  const auto sample = (*machine)->read();
  ASSERT_FALSE(sample);
  const std::string expected = GetParam().first == Kind::bytewise ? "machine_silent" : GetParam().second;
  EXPECT_EQ(std::string(name_of(sample.error().code)), expected);
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), 5.0);
}

INSTANTIATE_TEST_SUITE_P(FakeController, SporadicFault,
                         testing::Values(std::pair{Kind::busy, "machine_busy"}, std::pair{Kind::late, "machine_silent"},
                                         std::pair{Kind::wrong_transaction, "machine_bad_reply"},
                                         std::pair{Kind::truncated, "machine_silent"},
                                         std::pair{Kind::drop, "machine_link_lost"}, std::pair{Kind::bytewise, ""},
                                         std::pair{Kind::refused, "machine_gateway"},
                                         std::pair{Kind::wrong_unit, "machine_bad_reply"}));

TEST(ModbusMachine, UnreachableAndForeignDevicesAreNamed) {
  Profile nobody;
  nobody.controller.port = 1;
  auto machine = ModbusMachine::open(nobody, engineer());
  ASSERT_TRUE(machine);
  EXPECT_EQ((*machine)->identify().error().code, ErrorCode::machine_unreachable);
  Bank bank;
  bank.start();
  bank.words[0] = 1234;
  auto foreign = ModbusMachine::open(bank.profile(), engineer());
  EXPECT_EQ((*foreign)->identify().error().code, ErrorCode::machine_unsupported);
  bank.words[0] = 0x5A44;
  bank.words[6] = 1;
  EXPECT_EQ((*foreign)->identify().error().code, ErrorCode::machine_unsupported);
  Profile unknown_map = bank.profile();
  unknown_map.controller.register_map = "no-such-map";
  EXPECT_EQ(ModbusMachine::open(unknown_map, engineer()).error().code, ErrorCode::file_not_found);
}

}  // namespace zerodrift::controller
