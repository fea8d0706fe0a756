// The host compensator, the sign check and the probes, against a small device and a pymodbus peer.

#include <gtest/gtest.h>

#include <cmath>
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
  auto machine = ModbusMachine::open(profile);
  EXPECT_TRUE(machine) << describe(machine.error());
  return std::move(*machine);
}

/// Sees what the device applies, turned and mixed as told.
class Watcher : public acquisition::ErrorSource {
 public:
  Watcher(Device& device, double sign, bool swap_xy) : m_device(device), m_sign(sign), m_swap(swap_xy) {}
  Status take_zero(const TaskContext&) override { return {}; }
  Result<acquisition::ErrorSample> measure(const TaskContext&) override {
    acquisition::ErrorSample sample{};
    for (std::size_t i = 0; i < 3; ++i) sample.error_um[i] = m_sign * m_device.float_at(40 + 2 * static_cast<int>(i));
    if (m_swap) std::swap(sample.error_um[0], sample.error_um[1]);
    return sample;
  }
  std::string name() const override { return "watcher"; }

 private:
  Device& m_device;
  double m_sign;
  bool m_swap;
};

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

TEST(HostCompensator, IsInterlocked) {
  Device device;
  auto machine = open(device.profile());
  EXPECT_EQ(run_host_compensator(*machine, model(), {}, {}).error().code, ErrorCode::interlock_compensation_off);
  ASSERT_TRUE(upload_table(*machine, model(), {}, {}).result);
  EXPECT_EQ(run_host_compensator(*machine, model(), {}, {}).error().code, ErrorCode::data_does_not_fit);
}

TEST(SignCheck, PassesWithTheRightSign) {
  Device device;
  auto machine = open(device.profile());
  Watcher watcher(device, 1.0, false);
  const auto record = check_signs(*machine, watcher, {}, {});
  ASSERT_TRUE(record.result) << describe(record.result.error());
  ASSERT_EQ(record.axes.size(), 3U);
  EXPECT_DOUBLE_EQ(record.axes[2].seen_um[2], 10.0);
  EXPECT_EQ(device.word(17), 0);  // as it was found
  EXPECT_DOUBLE_EQ(device.float_at(144), 0.0);
}

TEST(SignCheck, AWrongSignOrAxisStops) {
  Device device;
  auto machine = open(device.profile());
  Watcher turned(device, -1.0, false);
  EXPECT_EQ(check_signs(*machine, turned, {}, {}).result.error().code, ErrorCode::sign_check_failed);
  Watcher swapped(device, 1.0, true);
  const auto record = check_signs(*machine, swapped, {}, {});
  EXPECT_EQ(record.result.error().code, ErrorCode::sign_check_failed);
  EXPECT_EQ(record.result.error().context.at("axis"), "X");
  EXPECT_EQ(device.word(17), 0);
  EXPECT_DOUBLE_EQ(device.float_at(140), 0.0);
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
