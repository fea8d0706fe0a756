#include "core/acquisition/trend.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zerodrift::acquisition {
namespace {

TEST(Trend, SlopesOfStraightLines) {
  Trend trend(60.0);
  for (int i = 0; i <= 60; ++i) {
    const double t = 60.0 * i;
    const double h = t / 3600.0;
    trend.add_temperatures(t, std::vector<double>{20.0 + 1.0 * h, 20.0 - 3.0 * h, std::nan("")});
    trend.add_error(t, {2.0 * h, std::nan(""), -40.0 * h});
  }
  ASSERT_TRUE(trend.now().slope_um_per_h);
  EXPECT_NEAR(*trend.now().slope_um_per_h, -40.0, 1e-9);
  EXPECT_EQ(trend.now().slope_axis, 2);
  ASSERT_TRUE(trend.now().slope_K_per_h);
  EXPECT_NEAR(*trend.now().slope_K_per_h, -3.0, 1e-9);
  EXPECT_EQ(trend.now().slope_sensor, 1);
  EXPECT_NEAR(trend.now().largest_error_um, 40.0, 1e-9);
  EXPECT_EQ(trend.now().largest_axis, 2);
}

TEST(Trend, NeedsSomeTimeForASlope) {
  Trend trend(60.0);
  for (int i = 0; i < 3; ++i) trend.add_error(60.0 * i, {0.0, 0.0, 1.0 * i});
  EXPECT_FALSE(trend.now().slope_um_per_h);
}

// Change of 60 um with a time constant of one hour: 37.9 um in the first hour, and under 15 % of it (5.7 um) over an
// hour when 60 (e - 1) exp(-t) < 5.69 um, that is from t = 2.90 h on.
TEST(Trend, SteadyByTheStandard) {
  Trend trend(60.0);
  double steady_h = 0.0;
  for (int i = 0; i <= 300 && steady_h == 0.0; ++i) {
    const double h = i / 60.0;
    trend.add_error(3600.0 * h, {0.0, 0.0, 60.0 * (1.0 - std::exp(-h))});
    if (trend.now().steady) steady_h = h;
  }
  EXPECT_NEAR(steady_h, 2.90, 0.03);
}

TEST(Trend, BeginsAnewWithAnotherSpeed) {
  Trend trend(60.0);
  int i = 0;
  for (; i <= 240; ++i) trend.add_error(60.0 * i, {0.0, 0.0, 0.01});
  EXPECT_TRUE(trend.now().steady);
  trend.conditions_changed(60.0 * i);
  EXPECT_FALSE(trend.now().steady);
  for (; i <= 300; ++i) trend.add_error(60.0 * i, {0.0, 0.0, 0.01});
  EXPECT_FALSE(trend.now().steady);
}

}  // namespace
}  // namespace zerodrift::acquisition
