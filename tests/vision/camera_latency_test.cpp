#include "core/vision/camera_latency.h"

#include <gtest/gtest.h>

#include "core/vision/calibration_run.h"
#include "tests/vision/late_camera.h"

namespace zerodrift::vision {
namespace {

using testing::LateCamera;
using testing::LateMachine;

LatencyPlan plan_of() {
  LatencyPlan plan;
  plan.centre_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
  plan.axes = {"X", "Z"};
  return plan;
}

Result<std::vector<acquisition::Latency>> measured(LateMachine& machine, const PictureSource& camera,
                                                   LatencyPlan plan = plan_of()) {
  return measure_latency(machine, {{"front", &camera, LateCamera::target}}, plan, {}, machine.clock);
}

TEST(CameraLatency, AConstantLatencyIsMeasuredToAPicture) {
  for (const double latency_s : {0.0, 0.3, 1.0, 2.5}) {
    for (const double frames_per_s : {8.0, 25.0}) {
      LateMachine machine;
      const LateCamera camera(machine, frames_per_s, [&](double) { return latency_s; });
      const auto found = measured(machine, camera);
      ASSERT_TRUE(found) << latency_s << ": " << describe(found.error());
      const acquisition::Latency& latency = found->front();
      const double picture_s = 1.0 / frames_per_s;
      EXPECT_NEAR(latency.mean_s, latency_s + 0.5 * picture_s, picture_s) << latency_s;
      EXPECT_GE(latency.settle().count(), latency_s) << "a picture stamped later than that shows the stand";
      EXPECT_LE(latency.settle().count(), latency_s + 3.0 * picture_s + 0.2) << latency_s;
      EXPECT_EQ(latency.observations, 8);
      EXPECT_EQ(machine.position_mm(machine.now()), (std::array{0.0, 0.0})) << "it ends where it began";
    }
  }
}

TEST(CameraLatency, AJumpingLatencyIsInsideMeanAndSpread) {
  LateMachine machine;
  // Another value every 0.7 s, between 0.2 and 1.0 s.
  const auto latency_s = [](double exposed_s) { return 0.6 + 0.4 * std::sin(7.3 * std::floor(exposed_s / 0.7)); };
  const LateCamera camera(machine, 25.0, latency_s);
  const auto found = measured(machine, camera);
  ASSERT_TRUE(found) << describe(found.error());
  EXPECT_GT(found->front().mean_s, 0.2);
  EXPECT_LT(found->front().mean_s, 1.1);
  EXPECT_GT(found->front().spread_s, 0.15) << "a constant one has a picture's time";
  EXPECT_GE(found->front().settle().count(), 0.9);
}

TEST(CameraLatency, ACameraThatNeverShowsTheMoveIsRefusedByName) {
  LateMachine machine;
  LateCamera camera(machine, 8.0, [](double) { return 0.1; });
  camera.blind = true;
  const auto found = measured(machine, camera);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::calibration_refused);
  EXPECT_EQ(found.error().context.at("reason"), "camera front: its picture does not follow the machine");
  EXPECT_EQ(machine.position_mm(machine.now()), (std::array{0.0, 0.0}));
}

TEST(CameraLatency, ASilentCameraIsRefused) {
  LateMachine machine;
  const LateCamera camera(machine, 8.0, [](double exposed_s) { return exposed_s > 5.0 ? 1e9 : 0.1; });
  const auto found = measured(machine, camera);
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().code, ErrorCode::camera_silent);
}

TEST(CameraLatency, AMachineKnownToBeAtRestIsNotWaitedForAgain) {
  LateMachine machine;
  const LateCamera camera(machine, 25.0, [](double) { return 0.3; });
  machine.clock.advance(Seconds(20.0));
  LatencyPlan plan = plan_of();
  const auto stand = acquisition::come_to(machine, plan.centre_mm, machine.clock);
  ASSERT_TRUE(stand);
  machine.clock.advance(Seconds(plan.longest_s));
  plan.home = *stand;
  const double began_s = machine.now();
  const auto found = measured(machine, camera, plan);
  ASSERT_TRUE(found) << describe(found.error());
  EXPECT_NEAR(found->front().mean_s, 0.32, 0.04);
  EXPECT_LT(machine.now() - began_s, 8 * 1.0) << "eight moves, each seen after latency and rest";
}

// --- calibration views -------------------------------------------------------------------------------------------

struct Calibrated {
  Result<CalibrationOutcome> outcome;
  double took_s;
};

Calibrated calibrated(LateMachine& machine, const LateCamera& camera) {
  const auto target = Target::create(camera.picture(-1.0, 999), LateCamera::target, std::nullopt, "template");
  EXPECT_TRUE(target);
  CalibrationPlan plan;
  plan.centre_mm = {{"X", 0.0}, {"Y", 0.0}, {"Z", 0.0}};
  plan.latency = {0.3, 0.1, 8};
  plan.frames = 2;
  machine.clock.advance(Seconds(10.0));
  const double began_s = machine.now();
  auto outcome = run_calibration(machine, camera, *target, {}, plan, {}, {}, machine.clock);
  return {std::move(outcome), machine.now() - began_s};
}

TEST(CalibrationViews, AreAllTakenWhereTheMachineWasSent) {
  LateMachine machine;
  const LateCamera camera(machine, 25.0, [](double) { return 0.3; });
  const Calibrated made = calibrated(machine, camera);
  ASSERT_TRUE(made.outcome) << describe(made.outcome.error());
  EXPECT_NEAR(made.outcome->calibration.scale_um_per_px, LateCamera::um_per_px, 0.05);
  EXPECT_LT(made.outcome->calibration.rms_um, 1.0);
}

TEST(CalibrationViews, AViewFartherOffThanHeatCanMakeIsTakenAnew) {
  LateMachine machine;
  const LateCamera camera(machine, 25.0, [](double) { return 0.3; });
  // While the last of the nine views is taken, each by two moves, the target is pushed aside by 25 um: the residual's
  // limit, 11 um rms, would let it pass.
  machine.slip_mm = [&machine](double time_s) {
    const int moves = machine.moves_until(time_s);
    return moves == 17 || moves == 18 ? 0.025 : 0.0;
  };
  const Calibrated made = calibrated(machine, camera);
  ASSERT_TRUE(made.outcome) << describe(made.outcome.error());
  EXPECT_LT(made.outcome->calibration.rms_um, 1.0) << "the view that was off is in none of it";
}

TEST(CalibrationViews, AViewThatStaysFartherOffThanHeatCanMakeIsRefusedByName) {
  LateMachine machine;
  const LateCamera camera(machine, 25.0, [](double) { return 0.3; });
  // The guide has a step: at one of the nine positions the target is always 25 um off.
  machine.slip_mm = [&machine](double time_s) {
    const auto at = machine.position_mm(time_s);
    return at[0] > 0.75 && at[1] > 0.75 ? 0.025 : 0.0;
  };
  const Calibrated made = calibrated(machine, camera);
  ASSERT_FALSE(made.outcome);
  EXPECT_EQ(made.outcome.error().code, ErrorCode::calibration_refused);
  const std::string reason = made.outcome.error().context.at("reason");
  EXPECT_NE(reason.find("position +0.800, +0.800 mm shows the target 2"), std::string::npos) << reason;
  EXPECT_NE(reason.find("from where the machine was sent, heat can make"), std::string::npos) << reason;
  EXPECT_EQ(machine.position_mm(machine.now()), (std::array{0.0, 0.0})) << "it ends where it began";
}

}  // namespace
}  // namespace zerodrift::vision
