// The sign check and the probes it may watch with, against a small device and a pymodbus peer.

#include "core/controller/sign_check.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/controller/probe_source.h"
#include "fake_controller.h"
#include "fixtures.h"
#include "peer.h"

namespace zerodrift::controller {
namespace {

/// Sees what the device applies, turned, mixed, scaled and drifting as told.
class Watcher : public acquisition::ErrorSource {
 public:
  explicit Watcher(FakeController& device, double gain = 1.0) : m_device(device), m_gain(gain) {}
  Status take_zero(const acquisition::Stand&, const TaskContext&) override { return {}; }
  Result<acquisition::ErrorSample> measure(const acquisition::Stand&, const TaskContext&) override {
    ++looks;
    if (on_look) on_look(looks);
    acquisition::ErrorSample sample{};
    // Heat follows the machine's clock (60 times ours, as in SignCheckTest), however slow the looks are.
    const double t_s = 60.0 * std::chrono::duration<double>(std::chrono::steady_clock::now() - m_started).count();
    for (std::size_t i = 0; i < 3; ++i) {
      sample.error_um[i] =
          m_gain * m_device.float_at(40 + 2 * static_cast<int>(i)) + drift_um_per_s * (t_s + 0.002 * t_s * t_s);
      sample.sigma_um[i] = sigma_um;
    }
    if (swap_xy) std::swap(sample.error_um[0], sample.error_um[1]);
    return sample;
  }
  std::string name() const override { return "watcher"; }

  bool swap_xy = false;
  double drift_um_per_s = 0.0;
  double sigma_um = 0.05;
  int looks = 0;
  std::function<void(int)> on_look;

 private:
  FakeController& m_device;
  double m_gain;
  std::chrono::steady_clock::time_point m_started = std::chrono::steady_clock::now();
};

/// A device whose clock runs 60 times as fast as ours, so that settling takes milliseconds.
class SignCheckTest : public testing::Test {
 protected:
  SignCheckTest() {
    device.run_clock(60.0);
    Profile profile = device.profile();
    profile.time_factor = 60.0;
    machine = open(profile);
  }
  SignCheckRecord check(Watcher& watcher) { return check_signs(*machine, watcher, {}, {}); }
  /// "passed", or axis and fault.
  std::string found_by(Watcher& watcher) {
    const SignCheckRecord record = check(watcher);
    if (record.result) return "passed";
    const auto& context = record.result.error().context;
    if (!context.contains("seen_um")) return describe(record.result.error());
    const std::string& seen = context.at("seen_um");
    return context.at("axis") + ": " + seen.substr(seen.find(" - ") + 3);
  }

  FakeController device;
  std::unique_ptr<ModbusMachine> machine;
};

}  // namespace

// However a look ends, the test offset is out of the machine afterwards; where it cannot be, what stands there is told.
TEST_F(SignCheckTest, ALookThatFailsOrThrowsDoesNotKeepTheOffset) {
  for (const bool throws : {false, true}) {
    Watcher watcher(device);
    watcher.on_look = [&](int look) {
      if (look != 2) return;
      EXPECT_GT(std::abs(device.float_at(140)), 5.0) << "this look is one with the offset";
      if (throws) throw std::runtime_error("a picture of no size");
      device.set_on_write(refusing_once(140));
    };
    const auto record = check(watcher);
    ASSERT_FALSE(record.result);
    EXPECT_EQ(record.result.error().code, throws ? ErrorCode::internal : ErrorCode::machine_exception)
        << describe(record.result.error());
    EXPECT_DOUBLE_EQ(device.float_at(140), 0.0);
    EXPECT_EQ(device.word(17), 0);
  }
}

TEST_F(SignCheckTest, AnOffsetThatStaysIsTold) {
  Watcher watcher(device);
  watcher.on_look = [&](int look) {
    if (look != 2) return;
    device.set_on_write([](int address, std::span<const std::uint16_t>) -> std::optional<ModbusException> {
      return address == 140 ? std::optional(ModbusException::illegal_value) : std::nullopt;
    });
  };
  const auto record = check(watcher);
  ASSERT_FALSE(record.result);
  EXPECT_EQ(record.result.error().code, ErrorCode::compensation_left) << describe(record.result.error());
  EXPECT_EQ(record.result.error().context.at("held"), "X 10.0, Y 0.0, Z 0.0 um");
  EXPECT_EQ(record.result.error().context.at("switch"), "off");
}

TEST_F(SignCheckTest, PassesWithTheRightSign) {
  Watcher watcher(device);
  const auto record = check(watcher);
  ASSERT_TRUE(record.result) << describe(record.result.error());
  ASSERT_EQ(record.axes.size(), 3U);
  EXPECT_NEAR(record.axes[2].seen_um[2], 10.0, 1e-9);
  EXPECT_GT(record.axes[2].sigma_um[2], 0.03);
  EXPECT_EQ(device.word(17), 0);  // as it was found
  EXPECT_DOUBLE_EQ(device.float_at(144), 0.0);
}

TEST_F(SignCheckTest, AWrongSignOrAxisStops) {
  Watcher turned(device, -1.0);
  EXPECT_EQ(found_by(turned), "X: the sign is wrong");
  Watcher swapped(device);
  swapped.swap_xy = true;
  EXPECT_EQ(found_by(swapped), "X: it moves Y, the wrong axis");
  EXPECT_EQ(device.word(17), 0);
  EXPECT_DOUBLE_EQ(device.float_at(140), 0.0);
}

TEST_F(SignCheckTest, AWrongSizeAndNothingAtAllStop) {
  for (const double gain : {0.52, 0.65, 1.35, 2.0}) {
    Watcher wrong(device, gain);
    EXPECT_EQ(found_by(wrong), "X: the size is wrong") << gain;
  }
  for (const double gain : {0.75, 1.25}) {
    Watcher close(device, gain);
    EXPECT_EQ(found_by(close), "passed") << gain;
  }
  Watcher blind(device, 0.01);
  EXPECT_EQ(found_by(blind), "X: nothing moves");
  Watcher coarse(device);
  coarse.sigma_um = 20.0;
  EXPECT_NE(found_by(coarse).find("too uncertain"), std::string::npos);
}

TEST_F(SignCheckTest, ADriftMeanwhileIsNoMove) {
  Watcher watcher(device);
  watcher.drift_um_per_s = -0.3;  // and growing
  const auto record = check(watcher);
  ASSERT_TRUE(record.result) << describe(record.result.error());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(record.axes[i].seen_um[i], 10.0, 0.5);
}

TEST_F(SignCheckTest, AnOffsetThatIsTakenOutMeanwhileIsMeasuredAgain) {
  Watcher watcher(device);
  watcher.on_look = [&](int look) {  // as the controller's watchdog does
    if (look != 2) return;
    device.set_float(140, 4.0);
    device.set_float(40, 4.0);
  };
  const auto record = check(watcher);
  ASSERT_TRUE(record.result) << describe(record.result.error());
  EXPECT_NEAR(record.axes[0].seen_um[0], 10.0, 1e-9);
  Watcher always(device);
  always.on_look = [&](int) { device.set_float(140, 4.0); };
  EXPECT_EQ(check(always).result.error().code, ErrorCode::machine_not_ready);
}

TEST(SignCheck, APeersProbesSeeTheOffset) {
  const Peer peer({"--speedup", "60"});
  if (!peer.running()) GTEST_SKIP() << "python3-pymodbus is not installed";
  auto machine = open(*read_profile(peer.profile_file()));
  ASSERT_TRUE(machine->move_to({{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}}));
  ProbeErrorSource probes(*machine);
  ASSERT_TRUE(probes.take_zero(acquisition::standing_now(), {}));
  const auto record = check_signs(*machine, probes, {}, {});
  ASSERT_TRUE(record.result) << describe(record.result.error());
  EXPECT_NEAR(record.axes[0].seen_um[0], 10.0, 1.0);
  ASSERT_TRUE(machine->move_to({{"X", 10.0}}));
  const auto away = probes.measure(acquisition::standing_now(), {});
  ASSERT_TRUE(away);
  EXPECT_TRUE(std::isnan(away->error_um[0]));
  EXPECT_FALSE(away->problems.empty());
}

}  // namespace zerodrift::controller
