#include "core/analysis/clustering.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "tests/analysis/support.h"

namespace zerodrift::analysis {

using test::machine_run;

TEST(Clustering, GroupsTheSensorsOfEachBody) {
  ClusterOptions options;
  options.distance = Distance::standardised;  // sensors of a body differ in rise, not in shape
  const auto result = cluster(machine_run({}), options);
  ASSERT_TRUE(result) << describe(result.error());
  ASSERT_EQ(result->sensitive_points.size(), 5U);
  EXPECT_EQ(std::set<std::string>(result->sensitive_points.begin(), result->sensitive_points.end()).size(), 5U);
  // The fastest body stands apart whatever else is drawn.
  for (int s = 1; s < 4; ++s) EXPECT_EQ(result->sensors[s].cluster, result->sensors[0].cluster);
  EXPECT_GT(result->stability, 0.5);
  EXPECT_LT(result->condition_sensitive, result->condition_all);
}

TEST(Clustering, AbsoluteSumWhenTheErrorsOppose) {
  const auto result = cluster(machine_run({}));
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->absolute_criterion) << result->criterion_reason;
  for (const auto& facts : result->sensors) {
    ASSERT_EQ(facts.correlation.size(), 3U);
    EXPECT_NEAR(facts.signed_sum, facts.correlation[0] + facts.correlation[1] + facts.correlation[2], 1e-12);
    EXPECT_GE(facts.absolute_sum, std::abs(facts.signed_sum) - 1e-12);
  }
}

TEST(Clustering, IsTheSameForTheSameSeed) {
  ClusterOptions options;
  options.seed = 4;
  const auto a = cluster(machine_run({}), options);
  const auto b = cluster(machine_run({}), options);
  ASSERT_TRUE(a && b);
  EXPECT_EQ(to_json(*a), to_json(*b));
}

TEST(Clustering, JsonHoldsOnlyNumbers) {
  auto r = machine_run({});
  r.find("T2_C")->values = r.find("T1_C")->values;
  const auto result = cluster(r);
  ASSERT_TRUE(result);
  const std::string text = to_json(*result).dump();
  EXPECT_EQ(text.find("null"), std::string::npos);
  EXPECT_NE(text.find("duplicate_sensor"), std::string::npos);
}

TEST(Clustering, MoreClustersThanSensorsIsRefused) {
  ClusterOptions options;
  options.clusters = 21;
  const auto result = cluster(machine_run({}), options);
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::bad_argument);
}

}  // namespace zerodrift::analysis
