#include "core/acquisition/sensor_watch.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

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

// Each fault begins in the middle of a run; 12 sensors, one reading in 10 s.
class SensorFault : public testing::Test {
 protected:
  using Values = std::vector<double>;
  /// Readings until the fault is named; what was said before it began is a false alarm.
  int readings_until(ErrorCode code, const std::function<void(int since, Values&)>& fault) {
    SensorWatch watch(names(12));
    Noise noise(8);
    for (int i = 0; i < 600; ++i) {
      Values values;
      for (int s = 0; s < 12; ++s) values.push_back(reading(noise, 20.0 + s * 0.9 + 0.004 * i * s));
      if (i >= begin) fault(i - begin, values);
      for (const auto& change : watch.add(10.0 * i, values)) {
        if (i < begin) return -1000;
        if (change.failed && change.error.code == code) {
          said = change.error.context;
          return i - begin + 1;
        }
      }
    }
    return -1;
  }
  static constexpr int begin = 300;
  std::map<std::string, std::string> said;
};

TEST_F(SensorFault, SpikingIsToldAtTheSecondSpike) {
  const int told = readings_until(ErrorCode::sensor_spiking, [](int since, Values& v) {
    if (since % 40 == 0) v[4] += since % 80 == 0 ? 25.0 : -60.0;
  });
  EXPECT_GT(told, 0);
  EXPECT_LE(told, 42);
}

TEST_F(SensorFault, ReplugElsewhereIsAJump) {
  const int told = readings_until(ErrorCode::sensor_jumped,
                                  [](int since, Values& v) { v[4] = since < 6 ? std::nan("") : v[4] + 8.0; });
  EXPECT_GT(told, 6);
  EXPECT_LE(told, 6 + 3);
  EXPECT_EQ(said.at("sensor"), "T5_C");
}

TEST_F(SensorFault, SwappedAreNamedBoth) {
  const int told = readings_until(ErrorCode::sensor_swapped, [](int, Values& v) { std::swap(v[2], v[9]); });
  EXPECT_EQ(told, 3);
  EXPECT_EQ(said.at("sensor"), "T3_C");
  EXPECT_EQ(said.at("other"), "T10_C");
}

TEST_F(SensorFault, DeadAndStuck) {
  EXPECT_EQ(readings_until(ErrorCode::sensor_dead, [](int, Values& v) { v[1] = std::nan(""); }), 1);
  double kept = 0.0;
  const int told = readings_until(ErrorCode::sensor_stuck, [&](int since, Values& v) {
    if (since == 0) kept = v[1];
    v[1] = kept;
  });
  EXPECT_GT(told, 0);
  EXPECT_LE(told, 60);
}

TEST(SensorWatch, CoolantThatSetsInIsNoFault) {
  SensorWatch watch(names(6));
  Noise noise(9);
  for (int i = 0; i < 400; ++i) {
    std::vector<double> values;
    for (int s = 0; s < 6; ++s) {
      const double fall = i > 200 ? 6.0 * (1.0 - std::exp(-(i - 200) * 10.0 / 30.0)) : 0.0;  // 30 s time constant
      values.push_back(reading(noise, 30.0 + s - fall));
    }
    ASSERT_TRUE(watch.add(10.0 * i, values).empty()) << i;
  }
}

}  // namespace
}  // namespace zerodrift::acquisition
