#pragma once
// k-means++ (Arthur and Vassilvitskii 2007) as published for temperature-sensitive points: the first centre is a given
// item (the sensor most correlated with the error), the next are drawn with probability D(x)^2 / sum D^2 (roulette),
// then Lloyd's steps until the centres rest. Items are rows; distances are Euclidean.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace zerodrift::analysis {

struct Clustering {
  std::vector<int> cluster_of;     // item -> cluster, 0-based, numbered by first item
  Eigen::MatrixXd centres;         // clusters x coordinates
  std::vector<int> initial_items;  // the items that seeded the centres, in the order they were drawn
  double inertia = 0.0;            // sum of squared distances to the own centre
  int iterations = 0;
};

/// `first_item` -1 draws the first centre too. count is clipped to the number of items.
Clustering kmeans_plus_plus(const Eigen::MatrixXd& items, int count, int first_item, std::uint64_t seed);
/// Lloyd's steps from given centres.
Clustering lloyd(const Eigen::MatrixXd& items, Eigen::MatrixXd centres);

/// Silhouette of each item (Rousseeuw 1987), -1..1; 0 for an item alone in its cluster.
std::vector<double> silhouettes(const Eigen::MatrixXd& items, const std::vector<int>& cluster_of);
double mean_of(const std::vector<double>& values);

/// How far two partitions agree (Hubert and Arabie 1985): 1 the same, 0 as by chance.
double adjusted_rand(const std::vector<int>& a, const std::vector<int>& b);

struct CountScore {
  int count = 0;
  double silhouette = 0.0;
  double gap = 0.0;        // Tibshirani, Walther and Hastie 2001
  double gap_sigma = 0.0;  // its simulation error
};
struct CountSuggestion {
  int by_silhouette = 2;  // the largest mean silhouette
  int by_gap = 1;         // the smallest k with gap(k) >= gap(k + 1) - sigma(k + 1)
  std::vector<CountScore> scores;
};
/// For k = 1 .. min(largest, items - 1); the best of several draws each.
CountSuggestion suggest_count(const Eigen::MatrixXd& items, int largest, std::uint64_t seed);

/// One step of average linkage (UPGMA, Sokal and Michener 1958). Items are 0 .. n-1, merges n, n+1, ...
struct Merge {
  int a = 0;
  int b = 0;
  double height = 0.0;  // mean distance between the two
  int size = 0;
};
std::vector<Merge> dendrogram(const Eigen::MatrixXd& items);

}  // namespace zerodrift::analysis
