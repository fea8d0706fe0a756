#include "core/acquisition/sensor_watch.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/noise.h"

namespace zerodrift::acquisition {
namespace {

double reading(Noise& noise, double truth) {
  return std::round(16.0 * (truth + 0.1 * noise.normal())) / 16.0;
}

std::vector<std::string> names(int count) {
  std::vector<std::string> out;
  for (int i = 0; i < count; ++i) out.push_back("T" + std::to_string(i + 1) + "_C");
  return out;
}

TEST(SensorWatch, LeavesHealthySensorsAlone) {
  SensorWatch watch(names(20));
  Noise noise(3);
  for (int i = 0; i < 8640; ++i) {  // a day at 10 s
    std::vector<double> values;
    for (int s = 0; s < 20; ++s) values.push_back(reading(noise, 20.0 + 0.001 * i));
    ASSERT_TRUE(watch.add(10.0 * i, values).empty()) << i;
  }
}

TEST(SensorWatch, FindsAStuckSensorWithinMinutes) {
  for (const int from : {0, 500}) {  // from the start, and in the run
    SensorWatch watch(names(20));
    Noise noise(4);
    double kept = 20.0;
    int found = -1;
    for (int i = 0; i < 700 && found < 0; ++i) {
      std::vector<double> values;
      for (int s = 0; s < 20; ++s) values.push_back(reading(noise, 20.0));
      if (i >= from) values[6] = kept;
      kept = values[6];
      for (const auto& change : watch.add(10.0 * i, values)) {
        EXPECT_EQ(change.channel, "T7_C");
        EXPECT_EQ(change.error.code, ErrorCode::sensor_stuck);
        found = i;
      }
    }
    ASSERT_GE(found, 0);
    EXPECT_LE(found - from, 60);  // ten minutes
  }
}

TEST(SensorWatch, FindsADeadSensorAtOnceAndItsReturn) {
  SensorWatch watch(names(2));
  Noise noise(5);
  EXPECT_TRUE(watch.add(0.0, {20.0, 20.0}).empty());
  const auto dead = watch.add(10.0, {20.1, std::nan("")});
  ASSERT_EQ(dead.size(), 1u);
  EXPECT_TRUE(dead[0].failed);
  EXPECT_EQ(dead[0].error.code, ErrorCode::sensor_dead);
  EXPECT_TRUE(watch.add(20.0, {20.0, std::nan("")}).empty());
  const auto back = watch.add(30.0, {20.1, 20.3});
  ASSERT_EQ(back.size(), 1u);
  EXPECT_FALSE(back[0].failed);
}

TEST(SensorWatch, SaysNothingWhereAllSensorsAreQuiet) {
  SensorWatch watch(names(3));
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(watch.add(i, {20.0, 20.0, 20.0}).empty());
}

}  // namespace
}  // namespace zerodrift::acquisition
