#include "core/base/error.h"

#include <gtest/gtest.h>

#include <set>

#include "core/base/time_text.h"

namespace zerodrift {

TEST(Error, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  for (int i = 0; i < error_code_count(); ++i) names.insert(name_of(static_cast<ErrorCode>(i)));
  EXPECT_EQ(static_cast<int>(names.size()), error_code_count());
}

TEST(Error, InnermostContextWins) {
  const Error error = Error{ErrorCode::csv_empty, {{"file", "inner.csv"}}}.with("file", "outer.csv").with("line", "3");
  EXPECT_EQ(describe(error), "csv_empty file=inner.csv line=3");
}

TEST(TimeText, RoundTrips) {
  const auto time = utc_from_text("2026-11-20T10:15:30.250Z");
  ASSERT_TRUE(time.has_value());
  EXPECT_EQ(to_text(*time), "2026-11-20T10:15:30.250Z");
  EXPECT_FALSE(utc_from_text("yesterday").has_value());
  EXPECT_FALSE(utc_from_text("2026-13-20T10:15:30.250Z").has_value());
}

}  // namespace zerodrift
