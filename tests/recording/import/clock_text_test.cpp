#include "core/recording/import/clock_text.h"

#include <gtest/gtest.h>

namespace zerodrift::recording {
namespace {

constexpr std::int64_t second_ns = 1'000'000'000;
constexpr std::int64_t of_day_s = 7 * 3600 + 12 * 60 + 40;

}  // namespace

TEST(ClockText, ReadsDatesOfOneMeaning) {
  const std::chrono::sys_days day = std::chrono::year{2025} / 11 / 3;
  for (const char* text : {"2025-11-03T07:12:40Z", "2025-11-03 07:12:40", "2025/11/03 07:12:40", "20251103T071240",
                           "03.11.2025 07:12:40", "3-Nov-2025 07:12:40", "3 Nov 2025 07:12:40",
                           "Nov 3, 2025 7:12:40 AM", "03. Nov 2025 07:12:40", "03.11.25 07:12:40",
                           "2025\xE5\xB9\xB4"
                           "11\xE6\x9C\x88"
                           "3\xE6\x97\xA5 07:12:40",
                           "2025-11-03T07:12:40+01:00"}) {
    const auto clock = read_clock_text(text);
    ASSERT_TRUE(clock.has_value()) << text;
    ASSERT_EQ(clock->orders.size(), 1U) << text;
    EXPECT_EQ(day_of(*clock, clock->orders.front()), day) << text;
    EXPECT_EQ(clock->of_day_ns, of_day_s * second_ns) << text;
  }
  EXPECT_EQ(read_clock_text("2025-11-03T07:12:40+01:00")->zone_minutes, 60);
  EXPECT_EQ(read_clock_text("2025-11-03T07:12:40.121Z")->of_day_ns, of_day_s * second_ns + 121'000'000);
  EXPECT_EQ(read_clock_text("03/11/2025 07:12:40:442")->of_day_ns, of_day_s * second_ns + 442'000'000);
}

TEST(ClockText, DatesOfTwoMeaningsKeepBoth) {
  EXPECT_EQ(read_clock_text("03/11/2025")->orders.size(), 2U);
  EXPECT_EQ(read_clock_text("11/03/25 07:12:40 PM")->orders.size(), 3U);
  EXPECT_FALSE(day_of(*read_clock_text("11/23/2025"), DateOrder::day_month_year));
  EXPECT_TRUE(day_of(*read_clock_text("11/23/2025"), DateOrder::month_day_year));
}

TEST(ClockText, NumbersAndWordsAreNoTimes) {
  for (const char* text :
       {"20.5", "1,020", "7", "OFF", "101 (C)", "1.2.3.4", "a:b", "12:61", "2025-11", "-", "20251103"}) {
    EXPECT_FALSE(read_clock_text(text).has_value()) << text;
  }
  EXPECT_EQ(read_clock_text("26:00:01")->of_day_ns, (26 * 3600 + 1) * second_ns);
  EXPECT_EQ(read_clock_text("12:30:00 AM")->of_day_ns, 1800 * second_ns);
}

TEST(ClockText, FollowsAPattern) {
  const auto clock = read_clock_text("03/11/2025 07:12:40.5", "%d/%m/%Y %H:%M:%S");
  ASSERT_TRUE(clock.has_value());
  EXPECT_EQ(day_of(*clock, clock->orders.front()), std::chrono::sys_days{std::chrono::year{2025} / 11 / 3});
  EXPECT_EQ(clock->of_day_ns, of_day_s * second_ns + second_ns / 2);
  EXPECT_EQ(read_clock_text("11/03/25 07:12 PM", "%m/%d/%y %I:%M %p")->of_day_ns, (19 * 3600 + 12 * 60) * second_ns);
  EXPECT_FALSE(read_clock_text("03.11.2025", "%d/%m/%Y").has_value());
}

}  // namespace zerodrift::recording
