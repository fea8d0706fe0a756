#include "core/recording/recording.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace zerodrift::recording {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

Recording sample() {
  return {"r", {0, 10, 20, 30}, {{"T1_C", {20, missing, 24, 25}}, {"spindle_rpm", {0, 3000, missing, 0}}}};
}

}  // namespace

TEST(Recording, KindsComeFromNames) {
  EXPECT_EQ(kind_of("T1_C"), ChannelKind::temperature);
  EXPECT_EQ(kind_of("ambient_C"), ChannelKind::ambient);
  EXPECT_EQ(kind_of("feed_X_mm_min"), ChannelKind::feed);
  EXPECT_EQ(kind_of("heater_on"), ChannelKind::input);
  EXPECT_TRUE(is_input(kind_of("coolant_on")));
}

TEST(Recording, InterpolatesOverGapsAndHoldsInputs) {
  const Recording r = sample();
  EXPECT_DOUBLE_EQ(value_at(r, *r.find("T1_C"), 10), 22);
  EXPECT_DOUBLE_EQ(value_at(r, *r.find("T1_C"), 99), 25);
  EXPECT_DOUBLE_EQ(held_value_at(r, *r.find("spindle_rpm"), 25), 3000);
  EXPECT_DOUBLE_EQ(held_value_at(r, *r.find("spindle_rpm"), -5), 0);
}

TEST(Recording, MissingChannelNamesThoseThere) {
  const auto channel = sample().require("T9_C");
  ASSERT_FALSE(channel.has_value());
  EXPECT_EQ(channel.error().context.at("available"), "T1_C, spindle_rpm");
}

TEST(Recording, SliceByTimeIsHalfOpen) {
  const Recording cut = slice_time(sample(), 10, 30);
  EXPECT_EQ(cut.rows(), 2U);
  EXPECT_EQ(cut.channels[1].values[0], 3000);
}

}  // namespace zerodrift::recording
