#include "core/analysis/budget.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/analysis/support.h"

namespace zerodrift::analysis {
namespace {

TrainingSet training() {
  test::MachineCase c;
  c.speeds_rpm = {3000.0, 0.0, 1500.0, 4000.0};
  c.step_s = 3600.0;
  return *make_training({test::machine_run(c)}, {});
}

}  // namespace

TEST(Budget, SpreadOrderTakesOneSensorOfEachBodyFirst) {
  const auto order = spread_order(training());
  ASSERT_EQ(order.size(), 20U);
  std::set<int> bodies;
  for (int i = 0; i < 5; ++i) bodies.insert((std::stoi(order[i].substr(1)) - 1) / 4);
  EXPECT_GE(bodies.size(), 4U);
}

TEST(Budget, MoreSensorsLeaveLessUntilThereAreEnough) {
  const auto set = training();
  const auto curve = budget_curve(set, Method::ridge, 8);
  ASSERT_TRUE(curve) << describe(curve.error());
  ASSERT_EQ(curve->size(), 8U);
  EXPECT_LT((*curve)[5].held_out_rms_um, 0.3 * (*curve)[0].held_out_rms_um);
}

TEST(Budget, DroppingTheOnlyWitnessCostsMostAndATwinCostsLittle) {
  const auto set = training();
  const auto prices = price_of_dropping(set, Method::ridge, {"T1_C", "T5_C", "T9_C", "T13_C", "T14_C", "T17_C"});
  ASSERT_TRUE(prices);
  EXPECT_GT((*prices)[0].lost_percent, 50.0);
  EXPECT_LT((*prices)[3].lost_percent, (*prices)[0].lost_percent);
  EXPECT_LT((*prices)[4].lost_percent, 30.0);
}

}  // namespace zerodrift::analysis
