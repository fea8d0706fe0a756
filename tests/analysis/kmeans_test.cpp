#include "core/analysis/kmeans.h"

#include <gtest/gtest.h>

#include "core/base/noise.h"

namespace zerodrift::analysis {
namespace {

/// Four well separated groups of six points in the plane.
Eigen::MatrixXd four_groups() {
  Noise noise(5);
  Eigen::MatrixXd items(24, 2);
  for (int i = 0; i < 24; ++i) {
    const int g = i / 6;
    items.row(i) << 10.0 * (g % 2) + 0.4 * noise.normal(), 8.0 * (g / 2) + 0.4 * noise.normal();
  }
  return items;
}

}  // namespace

TEST(KMeans, FindsSeparatedGroupsFromAnySeed) {
  const Eigen::MatrixXd items = four_groups();
  std::vector<int> truth;
  for (int i = 0; i < 24; ++i) truth.push_back(i / 6);
  int found = 0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const Clustering c = kmeans_plus_plus(items, 4, 0, seed);
    EXPECT_EQ(c.initial_items.front(), 0);
    found += adjusted_rand(truth, c.cluster_of) == 1.0 ? 1 : 0;
  }
  EXPECT_GE(found, 18);  // the roulette may draw two centres in one group; k-means++ makes that rare
}

TEST(KMeans, LloydRestsWhereEveryItemIsNearestToItsOwnMean) {
  const Eigen::MatrixXd items = four_groups();
  const Clustering c = kmeans_plus_plus(items, 3, -1, 9);
  for (int i = 0; i < items.rows(); ++i) {
    int nearest = 0;
    (c.centres.rowwise() - items.row(i)).rowwise().squaredNorm().minCoeff(&nearest);
    EXPECT_EQ(nearest, c.cluster_of[i]);
  }
}

TEST(KMeans, FewerDifferentItemsThanClusters) {
  Eigen::MatrixXd items(4, 1);
  items << 1.0, 1.0, 2.0, 2.0;
  const Clustering c = kmeans_plus_plus(items, 4, 0, 1);
  EXPECT_EQ(c.centres.rows(), 2);
  EXPECT_EQ(c.inertia, 0.0);
}

TEST(KMeans, RouletteDrawsByTheSquareOfTheDistance) {
  // From item 0 the squared distances are 0, 1, 9: item 2 must be drawn nine times as often as item 1.
  Eigen::MatrixXd items(3, 1);
  items << 0.0, 1.0, -3.0;
  int far = 0;
  for (std::uint64_t seed = 0; seed < 4000; ++seed) far += kmeans_plus_plus(items, 2, 0, seed).initial_items[1] == 2;
  EXPECT_NEAR(far / 4000.0, 0.9, 0.02);
}

TEST(KMeans, SuggestsTheNumberOfGroups) {
  const CountSuggestion s = suggest_count(four_groups(), 8, 1);
  EXPECT_EQ(s.by_silhouette, 4);
  EXPECT_EQ(s.by_gap, 4);
  EXPECT_EQ(s.scores.size(), 8U);
}

TEST(KMeans, DendrogramOfThreePointsOnALine) {
  Eigen::MatrixXd items(3, 1);
  items << 0.0, 1.0, 5.0;
  const auto merges = dendrogram(items);
  ASSERT_EQ(merges.size(), 2U);
  EXPECT_EQ(merges[0].a, 0);
  EXPECT_EQ(merges[0].b, 1);
  EXPECT_DOUBLE_EQ(merges[0].height, 1.0);
  EXPECT_EQ(merges[1].a, 2);
  EXPECT_EQ(merges[1].b, 3);
  EXPECT_DOUBLE_EQ(merges[1].height, 4.5);  // mean of 5 and 4
  EXPECT_EQ(merges[1].size, 3);
}

TEST(KMeans, AdjustedRandIsOneForARenamedPartitionAndNearZeroByChance) {
  EXPECT_DOUBLE_EQ(adjusted_rand({0, 0, 1, 1, 2}, {2, 2, 0, 0, 1}), 1.0);
  EXPECT_LT(adjusted_rand({0, 0, 1, 1}, {0, 1, 0, 1}), 0.0);
}

}  // namespace zerodrift::analysis
