#include "core/base/error.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "core/base/error_json.h"
#include "core/base/time_text.h"

namespace zerodrift {

TEST(Error, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  for (int i = 0; i < error_code_count(); ++i) names.insert(name_of(static_cast<ErrorCode>(i)));
  EXPECT_EQ(static_cast<int>(names.size()), error_code_count());
}

TEST(Error, ADescriptionIsReadBack) {
  const Error error{ErrorCode::not_enough_data,
                    {{"what", "axis Z"}, {"found", "3 of 12 rows"}, {"needed", "at least x=6"}}};
  const auto again = error_described(describe(error));
  ASSERT_TRUE(again.has_value());
  EXPECT_EQ(again->code, error.code);
  EXPECT_EQ(again->context.at("found"), "3 of 12 rows");
  EXPECT_EQ(again->context.at("what"), "axis Z");
  EXPECT_EQ(error_described("cancelled")->code, ErrorCode::cancelled);
  EXPECT_FALSE(error_described("internal affairs").has_value());
  EXPECT_FALSE(error_described("axis X is busy what=1").has_value());
  const auto kept = error_from_json(to_json(error));
  ASSERT_TRUE(kept.has_value());
  EXPECT_EQ(kept->code, error.code);
  EXPECT_EQ(kept->context, error.context);
  EXPECT_FALSE(error_from_json({{"said", "code"}}).has_value());
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
