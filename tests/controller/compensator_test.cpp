// The host compensator, the sign check and the probes, against a small device and a pymodbus peer.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <limits>

#include "core/controller/host_compensator.h"
#include "core/controller/probe_source.h"
#include "core/controller/sign_check.h"
#include "core/controller/upload.h"
#include "device.h"
#include "peer.h"

namespace zerodrift::controller {
namespace {

compensation::Table model() {
  compensation::Table table;
  table.axes["Z"].terms = {{"T1_C", 2.0, 20.0, 0.0}};
  table.axes["Z"].max_um_per_s = 1e6;
  table.valid["T1_C"] = {18.0, 30.0};
  return table;
}

std::unique_ptr<ModbusMachine> open(const Profile& profile) {
  auto machine = ModbusMachine::open(profile, engineer());
  EXPECT_TRUE(machine) << describe(machine.error());
  return std::move(*machine);
}

/// Sees what the device applies, turned, mixed, scaled and drifting as told.
class Watcher : public acquisition::ErrorSource {
 public:
  explicit Watcher(Device& device, double gain = 1.0) : m_device(device), m_gain(gain) {}
  Status take_zero(const TaskContext&) override { return {}; }
  Result<acquisition::ErrorSample> measure(const TaskContext&) override {
    ++looks;
    if (on_look) on_look(looks);
    acquisition::ErrorSample sample{};
    // Heat follows the machine's clock (60 times ours, as in Quick), however slow the looks are.
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
  Device& m_device;
  double m_gain;
  std::chrono::steady_clock::time_point m_started = std::chrono::steady_clock::now();
};

/// A device whose clock runs 60 times as fast as ours, so that settling takes milliseconds.
struct Quick {
  Quick() {
    device.run_clock(60.0);
    Profile profile = device.profile();
    profile.time_factor = 60.0;
    machine = open(profile);
  }
  Device device;
  std::unique_ptr<ModbusMachine> machine;
};

std::string found_by(const SignCheckRecord& record) {
  if (record.result) return "passed";
  const auto& context = record.result.error().context;
  if (!context.contains("seen_um")) return describe(record.result.error());
  const std::string& seen = context.at("seen_um");
  return context.at("axis") + ": " + seen.substr(seen.find(" - ") + 3);
}

}  // namespace

TEST(HostCompensator, WritesThePredictionAndRunsToZero) {
  Device device;
  device.set(17, 1);
  device.set(100, 16 * 24);
  auto machine = open(device.profile());
  std::stop_source stop;
  HostCompensatorOptions options;
  options.period_s = 0.02;
  std::vector<CompensatorTurn> turns;
  int clock = 0;
  const auto summary =
      run_host_compensator(*machine, model(), options, {stop.get_token(), {}}, [&](const CompensatorTurn& turn) {
        turns.push_back(turn);
        device.set(9, static_cast<std::uint16_t>(clock += 100));  // a machine second a turn
        if (turns.size() == 5) {
          EXPECT_NEAR(device.float_at(144), -8.0, 1e-6);
        }
        if (turns.size() == 10) device.set(100, 16 * 60);  // far outside the training
        if (turns.size() == 15) {
          EXPECT_EQ(turn.output.mode, compensation::FollowerMode::held_at_edge);
          EXPECT_NEAR(device.float_at(144), -22.0, 1e-6);  // held at 31 C: 30 and the margin
          device.set(100, 0x8000);                         // broken wire
        }
        if (turns.size() == 25) {
          EXPECT_EQ(turn.output.mode, compensation::FollowerMode::safe_zero);
          EXPECT_DOUBLE_EQ(device.float_at(144), 0.0);
          device.set(100, 16 * 22);
        }
        if (turns.size() == 30) {
          EXPECT_NEAR(device.float_at(144), -4.0, 1e-6);
          stop.request_stop();
        }
      });
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_GE(summary->turns, 30);
  EXPECT_DOUBLE_EQ(device.float_at(144), 0.0);
}

// It answers, but its heartbeat stands: nothing more is written, so that its watchdog can act; it beats again: on we
// go.
TEST(HostCompensator, AControllerThatNoLongerBeatsIsNotWrittenTo) {
  Device device;
  device.set(17, 1);
  device.set(100, 16 * 24);
  auto machine = open(device.profile());
  std::stop_source stop;
  HostCompensatorOptions options;
  options.period_s = 0.02;
  options.silence_s = 0.1;
  int turns = 0;
  int lost = 0;
  std::uint16_t beat = 0;
  std::uint16_t at_silence = 0;
  bool again = false;
  const auto summary =
      run_host_compensator(*machine, model(), options, {stop.get_token(), {}}, [&](const CompensatorTurn& turn) {
        ++turns;
        if (turns < 20 || turns > 60) device.set(10, ++beat);
        device.set(9, static_cast<std::uint16_t>(100 * turns));
        if (turn.link_lost && ++lost == 1) at_silence = device.word(11);
        if (turns == 60) {
          EXPECT_GT(lost, 20);
          EXPECT_EQ(device.word(11), at_silence) << "our heartbeat must stop too";
        }
        again = again || (turns > 60 && !turn.link_lost);
        if (turns == 80) stop.request_stop();
      });
  ASSERT_TRUE(summary) << describe(summary.error());
  EXPECT_TRUE(again);
  EXPECT_EQ(summary->lost_turns, lost);
}

TEST(HostCompensator, IsInterlocked) {
  Device device;
  auto machine = open(device.profile());
  EXPECT_EQ(run_host_compensator(*machine, model(), {}, {}).error().code, ErrorCode::interlock_compensation_off);
  ASSERT_TRUE(upload_table(*machine, model(), {}, {}).result);
  EXPECT_EQ(run_host_compensator(*machine, model(), {}, {}).error().code, ErrorCode::data_does_not_fit);
}

TEST(SignCheck, PassesWithTheRightSign) {
  Quick quick;
  Watcher watcher(quick.device);
  const auto record = check_signs(*quick.machine, watcher, {}, {});
  ASSERT_TRUE(record.result) << describe(record.result.error());
  ASSERT_EQ(record.axes.size(), 3U);
  EXPECT_NEAR(record.axes[2].seen_um[2], 10.0, 1e-9);
  EXPECT_GT(record.axes[2].sigma_um[2], 0.03);
  EXPECT_EQ(quick.device.word(17), 0);  // as it was found
  EXPECT_DOUBLE_EQ(quick.device.float_at(144), 0.0);
}

TEST(SignCheck, AWrongSignOrAxisStops) {
  Quick quick;
  Watcher turned(quick.device, -1.0);
  EXPECT_EQ(found_by(check_signs(*quick.machine, turned, {}, {})), "X: the sign is wrong");
  Watcher swapped(quick.device);
  swapped.swap_xy = true;
  EXPECT_EQ(found_by(check_signs(*quick.machine, swapped, {}, {})), "X: it moves Y, the wrong axis");
  EXPECT_EQ(quick.device.word(17), 0);
  EXPECT_DOUBLE_EQ(quick.device.float_at(140), 0.0);
}

TEST(SignCheck, AWrongSizeAndNothingAtAllStop) {
  Quick quick;
  for (const double gain : {0.52, 0.65, 1.35, 2.0}) {
    Watcher wrong(quick.device, gain);
    EXPECT_EQ(found_by(check_signs(*quick.machine, wrong, {}, {})), "X: the size is wrong") << gain;
  }
  for (const double gain : {0.75, 1.25}) {
    Watcher close(quick.device, gain);
    EXPECT_EQ(found_by(check_signs(*quick.machine, close, {}, {})), "passed") << gain;
  }
  Watcher blind(quick.device, 0.01);
  EXPECT_EQ(found_by(check_signs(*quick.machine, blind, {}, {})), "X: nothing moves");
  Watcher coarse(quick.device);
  coarse.sigma_um = 20.0;
  EXPECT_NE(found_by(check_signs(*quick.machine, coarse, {}, {})).find("too uncertain"), std::string::npos);
}

TEST(SignCheck, ADriftMeanwhileIsNoMove) {
  Quick quick;
  Watcher watcher(quick.device);
  watcher.drift_um_per_s = -0.3;  // and growing
  const auto record = check_signs(*quick.machine, watcher, {}, {});
  ASSERT_TRUE(record.result) << describe(record.result.error());
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(record.axes[i].seen_um[i], 10.0, 0.5);
}

TEST(SignCheck, AnOffsetThatIsTakenOutMeanwhileIsMeasuredAgain) {
  Quick quick;
  Watcher watcher(quick.device);
  watcher.on_look = [&](int look) {  // as the controller's watchdog does
    if (look != 2) return;
    quick.device.set_float(140, 4.0);
    quick.device.set_float(40, 4.0);
  };
  const auto record = check_signs(*quick.machine, watcher, {}, {});
  ASSERT_TRUE(record.result) << describe(record.result.error());
  EXPECT_NEAR(record.axes[0].seen_um[0], 10.0, 1e-9);
  Watcher always(quick.device);
  always.on_look = [&](int) { quick.device.set_float(140, 4.0); };
  EXPECT_EQ(check_signs(*quick.machine, always, {}, {}).result.error().code, ErrorCode::machine_not_ready);
}

TEST(SignCheck, APeersProbesSeeTheOffset) {
  const Peer peer({"--speedup", "60"});
  if (!peer.running()) GTEST_SKIP() << "python3-pymodbus is not installed";
  auto machine = open(*read_profile(peer.profile_file()));
  ASSERT_TRUE(machine->move_to({{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}}));
  ProbeErrorSource probes(*machine);
  ASSERT_TRUE(probes.take_zero({}));
  const auto record = check_signs(*machine, probes, {}, {});
  ASSERT_TRUE(record.result) << describe(record.result.error());
  EXPECT_NEAR(record.axes[0].seen_um[0], 10.0, 1.0);
  ASSERT_TRUE(machine->move_to({{"X", 10.0}}));
  const auto away = probes.measure({});
  ASSERT_TRUE(away);
  EXPECT_TRUE(std::isnan(away->error_um[0]));
  EXPECT_FALSE(away->problems.empty());
}

}  // namespace zerodrift::controller
