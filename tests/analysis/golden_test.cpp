// Independent values by scikit-learn and scipy; golden/analysis/make_clustering.py says how they were made.

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/analysis/kmeans.h"
#include "core/analysis/statistics.h"

namespace zerodrift::analysis {
namespace {

nlohmann::json golden() {
  std::ifstream file(ZERODRIFT_SOURCE_DIR "/tests/golden/analysis/clustering.json");
  return nlohmann::json::parse(file);
}

Eigen::VectorXd vector_of(const nlohmann::json& list) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(list.size()));
  for (std::size_t i = 0; i < list.size(); ++i) v(static_cast<Eigen::Index>(i)) = list[i].get<double>();
  return v;
}

Eigen::MatrixXd items_of(const nlohmann::json& g) {
  Eigen::MatrixXd items(static_cast<Eigen::Index>(g["items"].size()), static_cast<Eigen::Index>(g["items"][0].size()));
  for (Eigen::Index i = 0; i < items.rows(); ++i) items.row(i) = vector_of(g["items"][static_cast<std::size_t>(i)]);
  return items;
}

}  // namespace

TEST(Golden, LloydFromTheSameCentres) {
  const auto g = golden();
  const Eigen::MatrixXd items = items_of(g);
  Eigen::MatrixXd centres(4, items.cols());
  for (int k = 0; k < 4; ++k) centres.row(k) = items.row(g["initial_items"][static_cast<std::size_t>(k)].get<int>());
  const Clustering c = lloyd(items, centres);
  const auto labels = g["labels"].get<std::vector<int>>();
  EXPECT_DOUBLE_EQ(adjusted_rand(c.cluster_of, labels), 1.0);
  EXPECT_NEAR(c.inertia, g["inertia"].get<double>(), 1e-9);
  const auto silhouette = silhouettes(items, c.cluster_of);
  for (std::size_t i = 0; i < silhouette.size(); ++i) {
    EXPECT_NEAR(silhouette[i], g["silhouettes"][i].get<double>(), 1e-12) << i;
  }
  EXPECT_NEAR(adjusted_rand(c.cluster_of, g["other_labels"].get<std::vector<int>>()), g["adjusted_rand"].get<double>(),
              1e-12);
}

/// The draws are random in both programs: compared are the probabilities of the second centre and the best partition.
TEST(Golden, PlusPlusDrawsAndFindsTheBestPartition) {
  const auto g = golden();
  const Eigen::MatrixXd items = items_of(g);
  constexpr int draws = 6000;
  std::vector<double> drawn(static_cast<std::size_t>(items.rows()), 0.0);
  double least = std::numeric_limits<double>::infinity();
  Clustering best;
  for (int seed = 0; seed < draws; ++seed) {
    const Clustering c = kmeans_plus_plus(items, 5, 0, static_cast<std::uint64_t>(seed));
    drawn[static_cast<std::size_t>(c.initial_items[1])] += 1.0;
    if (c.inertia >= least) continue;
    least = c.inertia;
    best = c;
  }
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    const double p = g["second_centre_probability"][i].get<double>();
    EXPECT_NEAR(drawn[i] / draws, p, 4.5 * std::sqrt(p * (1.0 - p) / draws) + 1e-12) << i;
  }
  EXPECT_NEAR(least, g["best_of_five_inertia"].get<double>(), 1e-9);
  EXPECT_DOUBLE_EQ(adjusted_rand(best.cluster_of, g["best_of_five"].get<std::vector<int>>()), 1.0);
}

TEST(Golden, AverageLinkage) {
  const auto g = golden();
  const auto merges = dendrogram(items_of(g));
  ASSERT_EQ(merges.size(), g["merges"].size());
  for (std::size_t i = 0; i < merges.size(); ++i) {
    EXPECT_EQ(merges[i].a, g["merges"][i][0].get<int>());
    EXPECT_EQ(merges[i].b, g["merges"][i][1].get<int>());
    EXPECT_NEAR(merges[i].height, g["merges"][i][2].get<double>(), 1e-9);
    EXPECT_EQ(merges[i].size, g["merges"][i][3].get<int>());
  }
}

TEST(Golden, PrincipalComponentsCorrelationAndInflation) {
  const auto g = golden();
  const Eigen::MatrixXd items = items_of(g);
  const auto pc = principal_components(items);
  const Eigen::VectorXd error = vector_of(g["error"]);
  for (Eigen::Index i = 0; i < items.rows(); ++i) {
    const auto at = static_cast<std::size_t>(i);
    EXPECT_NEAR(std::abs(pc.scores(i, 0)), g["pc1_absolute"][at].get<double>(), 1e-9);
    EXPECT_NEAR(pearson(items.row(i).transpose(), error), g["pearson"][at].get<double>(), 1e-12);
  }
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(pc.explained(k), g["explained"][static_cast<std::size_t>(k)].get<double>(), 1e-12);
  }
  Eigen::MatrixXd columns(items.cols(), 3);
  for (Eigen::Index k = 0; k < 3; ++k)
    columns.col(k) = items.row(g["vif_items"][static_cast<std::size_t>(k)].get<int>());
  const Eigen::VectorXd vif = variance_inflation(columns);
  for (Eigen::Index k = 0; k < 3; ++k) {
    EXPECT_NEAR(vif(k) / g["vif"][static_cast<std::size_t>(k)].get<double>(), 1.0, 1e-9);
  }
}

}  // namespace zerodrift::analysis
