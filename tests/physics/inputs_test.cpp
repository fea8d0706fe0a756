// What a recording's samples are taken for: spikes alone and in pairs, and steps that are none.
#include "core/physics/inputs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace zerodrift::physics {
namespace {

std::vector<double> ramp_C() {
  std::vector<double> values;
  for (int k = 0; k < 200; ++k) values.push_back(20.0 + 0.05 * k + 0.1 * std::sin(12.9898 * k * k));
  return values;
}

std::vector<std::size_t> marked(const std::vector<double>& values) {
  const std::vector<bool> mark = spikes(values, noise_width(values, 0.01));
  std::vector<std::size_t> rows;
  for (std::size_t k = 0; k < mark.size(); ++k) {
    if (mark[k]) rows.push_back(k);
  }
  return rows;
}

}  // namespace

TEST(Inputs, SpikesInEveryTwelfthSampleDoNotPassForNoise) {
  std::vector<double> values = ramp_C();
  std::vector<std::size_t> spiked;
  for (std::size_t k = 7; k < values.size(); k += 12) {
    values[k] = 85.0;
    spiked.push_back(k);
  }
  EXPECT_EQ(marked(values), spiked);
}

TEST(Inputs, SmallSpikesInEveryEighteenthSampleDoNotPassForNoise) {
  std::vector<double> values = ramp_C();
  const double without = noise_width(values, 0.01);
  std::vector<std::size_t> spiked;
  for (std::size_t k = 7; k < values.size(); k += 18) {
    values[k] += spiked.size() % 2 == 0 ? 2.0 : -3.0;
    spiked.push_back(k);
  }
  EXPECT_LT(noise_width(values, 0.01), 1.5 * without);
  EXPECT_EQ(marked(values), spiked);
}

TEST(Inputs, SpikesAreMarkedAloneAndTwoInARow) {
  std::vector<double> values = ramp_C();
  EXPECT_TRUE(marked(values).empty());
  values[30] += 40.0;
  values[32] -= 25.0;
  values[80] -= 30.0;  // two that look away from each other
  values[81] += 50.0;
  values[120] += 20.0;  // two alike, and one more close by
  values[121] += 30.0;
  values[123] += 60.0;
  values[160] -= 4.0;  // a small one beside a large one
  values[161] += 50.0;
  EXPECT_EQ(marked(values), (std::vector<std::size_t>{30, 32, 80, 81, 120, 121, 123, 160, 161}));
}

TEST(Inputs, AStepAndAShortRiseAreNoSpikes) {
  std::vector<double> values = ramp_C();
  for (std::size_t k = 100; k < values.size(); ++k) values[k] += 30.0;
  EXPECT_TRUE(marked(values).empty());
  for (std::size_t k = 40; k < 46; ++k) values[k] += 5.0;
  EXPECT_TRUE(marked(values).empty());
}

}  // namespace zerodrift::physics
