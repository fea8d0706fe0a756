#include "core/analysis/kmeans.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/base/noise.h"

namespace zerodrift::analysis {
namespace {

double squared_distance(const Eigen::MatrixXd& items, Eigen::Index item, const Eigen::MatrixXd& centres,
                        Eigen::Index centre) {
  return (items.row(item) - centres.row(centre)).squaredNorm();
}

/// Nearest centre of each item; the lowest number wins a tie.
void assign(const Eigen::MatrixXd& items, Clustering& clustering) {
  clustering.inertia = 0.0;
  for (Eigen::Index i = 0; i < items.rows(); ++i) {
    double best = std::numeric_limits<double>::infinity();
    for (Eigen::Index k = 0; k < clustering.centres.rows(); ++k) {
      const double d = squared_distance(items, i, clustering.centres, k);
      if (d < best) {
        best = d;
        clustering.cluster_of[static_cast<std::size_t>(i)] = static_cast<int>(k);
      }
    }
    clustering.inertia += best;
  }
}

/// Means of the clusters; an empty one takes the item farthest from its own centre.
Eigen::MatrixXd means(const Eigen::MatrixXd& items, const Clustering& clustering) {
  Eigen::MatrixXd centres = Eigen::MatrixXd::Zero(clustering.centres.rows(), items.cols());
  Eigen::VectorXi sizes = Eigen::VectorXi::Zero(clustering.centres.rows());
  for (Eigen::Index i = 0; i < items.rows(); ++i) {
    const int k = clustering.cluster_of[static_cast<std::size_t>(i)];
    centres.row(k) += items.row(i);
    ++sizes(k);
  }
  for (Eigen::Index k = 0; k < centres.rows(); ++k) {
    if (sizes(k) > 0) {
      centres.row(k) /= sizes(k);
      continue;
    }
    Eigen::Index farthest = 0;
    double most = -1.0;
    for (Eigen::Index i = 0; i < items.rows(); ++i) {
      const double d =
          squared_distance(items, i, clustering.centres, clustering.cluster_of[static_cast<std::size_t>(i)]);
      if (d > most) {
        most = d;
        farthest = i;
      }
    }
    centres.row(k) = items.row(farthest);
  }
  return centres;
}

/// Numbers the clusters by their first item, so that the result does not depend on the order of the draws.
void renumber(Clustering& clustering) {
  std::map<int, int> number;
  for (const int k : clustering.cluster_of) number.try_emplace(k, static_cast<int>(number.size()));
  Eigen::MatrixXd centres(static_cast<Eigen::Index>(number.size()), clustering.centres.cols());
  for (const auto& [from, to] : number) centres.row(to) = clustering.centres.row(from);
  for (int& k : clustering.cluster_of) k = number.at(k);
  clustering.centres = centres;
}

Eigen::MatrixXd distances(const Eigen::MatrixXd& items) {
  Eigen::MatrixXd d(items.rows(), items.rows());
  for (Eigen::Index i = 0; i < items.rows(); ++i) {
    for (Eigen::Index j = 0; j < items.rows(); ++j) d(i, j) = (items.row(i) - items.row(j)).norm();
  }
  return d;
}

Clustering best_of(const Eigen::MatrixXd& items, int count, int draws, std::uint64_t seed) {
  Clustering best;
  best.inertia = std::numeric_limits<double>::infinity();
  for (int d = 0; d < draws; ++d) {
    Clustering c = kmeans_plus_plus(items, count, -1, seed + static_cast<std::uint64_t>(d));
    if (c.inertia < best.inertia) best = std::move(c);
  }
  return best;
}

}  // namespace

Clustering lloyd(const Eigen::MatrixXd& items, Eigen::MatrixXd centres) {
  Clustering out;
  out.centres = std::move(centres);
  out.cluster_of.assign(static_cast<std::size_t>(items.rows()), 0);
  constexpr int most_iterations = 1000;
  for (out.iterations = 1; out.iterations <= most_iterations; ++out.iterations) {
    assign(items, out);
    const Eigen::MatrixXd next = means(items, out);
    const bool rest = (next - out.centres).cwiseAbs().maxCoeff() <= 1e-12 * (1.0 + next.cwiseAbs().maxCoeff());
    out.centres = next;
    if (rest) break;
  }
  assign(items, out);
  renumber(out);
  return out;
}

Clustering kmeans_plus_plus(const Eigen::MatrixXd& items, int count, int first_item, std::uint64_t seed) {
  const auto n = items.rows();
  count = std::clamp(count, 1, static_cast<int>(n));
  Noise noise(seed);
  std::vector<int> chosen;
  chosen.push_back(first_item >= 0 ? first_item : static_cast<int>(noise.index(static_cast<std::uint64_t>(n))));
  Eigen::VectorXd nearest = (items.rowwise() - items.row(chosen[0])).rowwise().squaredNorm();
  while (static_cast<int>(chosen.size()) < count) {
    const double total = nearest.sum();
    int next = -1;
    if (total > 0.0) {
      double left = noise.uniform() * total;
      for (Eigen::Index i = 0; i < n; ++i) {
        if (nearest(i) <= 0.0) continue;
        next = static_cast<int>(i);
        left -= nearest(i);
        if (left < 0.0) break;
      }
    }
    if (next < 0) break;  // every item is a centre already: fewer different items than clusters
    chosen.push_back(next);
    nearest = nearest.cwiseMin((items.rowwise() - items.row(next)).rowwise().squaredNorm());
  }
  Eigen::MatrixXd centres(static_cast<Eigen::Index>(chosen.size()), items.cols());
  for (std::size_t k = 0; k < chosen.size(); ++k) centres.row(static_cast<Eigen::Index>(k)) = items.row(chosen[k]);
  Clustering out = lloyd(items, std::move(centres));
  out.initial_items = std::move(chosen);
  return out;
}

std::vector<double> silhouettes(const Eigen::MatrixXd& items, const std::vector<int>& cluster_of) {
  const std::size_t n = cluster_of.size();
  const int count = n == 0 ? 0 : *std::max_element(cluster_of.begin(), cluster_of.end()) + 1;
  std::vector<double> out(n, 0.0);
  if (count < 2) return out;
  const Eigen::MatrixXd d = distances(items);
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<double> sum(static_cast<std::size_t>(count), 0.0);
    std::vector<int> size(static_cast<std::size_t>(count), 0);
    for (std::size_t j = 0; j < n; ++j) {
      if (j == i) continue;
      sum[cluster_of[j]] += d(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
      ++size[cluster_of[j]];
    }
    if (size[cluster_of[i]] == 0) continue;
    const double own = sum[cluster_of[i]] / size[cluster_of[i]];
    double other = std::numeric_limits<double>::infinity();
    for (int k = 0; k < count; ++k) {
      if (k != cluster_of[i] && size[k] > 0) other = std::min(other, sum[k] / size[k]);
    }
    const double larger = std::max(own, other);
    if (larger > 0.0 && std::isfinite(larger)) out[i] = (other - own) / larger;
  }
  return out;
}

double mean_of(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double v : values) sum += v;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

double adjusted_rand(const std::vector<int>& a, const std::vector<int>& b) {
  const auto pairs = [](double n) { return n * (n - 1.0) / 2.0; };
  std::map<std::pair<int, int>, int> both;
  std::map<int, int> in_a;
  std::map<int, int> in_b;
  for (std::size_t i = 0; i < a.size(); ++i) {
    ++both[{a[i], b[i]}];
    ++in_a[a[i]];
    ++in_b[b[i]];
  }
  double together = 0.0;
  double pairs_a = 0.0;
  double pairs_b = 0.0;
  for (const auto& [key, n] : both) together += pairs(n);
  for (const auto& [key, n] : in_a) pairs_a += pairs(n);
  for (const auto& [key, n] : in_b) pairs_b += pairs(n);
  const double all = pairs(static_cast<double>(a.size()));
  const double expected = all > 0.0 ? pairs_a * pairs_b / all : 0.0;
  const double most = 0.5 * (pairs_a + pairs_b);
  return most - expected > 0.0 ? (together - expected) / (most - expected) : 1.0;
}

CountSuggestion suggest_count(const Eigen::MatrixXd& items, int largest, std::uint64_t seed) {
  constexpr int draws = 10;
  constexpr int references = 20;
  CountSuggestion out;
  const int most = std::min(largest, static_cast<int>(items.rows()) - 1);
  const Eigen::RowVectorXd low = items.colwise().minCoeff();
  const Eigen::RowVectorXd range = items.colwise().maxCoeff() - low;
  double best_silhouette = -2.0;
  for (int k = 1; k <= most; ++k) {
    CountScore score;
    score.count = k;
    const Clustering own = best_of(items, k, draws, seed);
    score.silhouette = mean_of(silhouettes(items, own.cluster_of));
    Noise noise(seed + 7919);  // the same reference sets for every k
    std::vector<double> logs;
    for (int b = 0; b < references; ++b) {
      Eigen::MatrixXd reference(items.rows(), items.cols());
      for (Eigen::Index i = 0; i < reference.rows(); ++i) {
        for (Eigen::Index j = 0; j < reference.cols(); ++j) reference(i, j) = low(j) + noise.uniform() * range(j);
      }
      logs.push_back(std::log(std::max(best_of(reference, k, 3, seed).inertia, 1e-300)));
    }
    const double mean = mean_of(logs);
    double variance = 0.0;
    for (const double l : logs) variance += (l - mean) * (l - mean) / references;
    score.gap = mean - std::log(std::max(own.inertia, 1e-300));
    score.gap_sigma = std::sqrt(variance * (1.0 + 1.0 / references));
    if (k >= 2 && score.silhouette > best_silhouette) {
      best_silhouette = score.silhouette;
      out.by_silhouette = k;
    }
    out.scores.push_back(score);
  }
  out.by_gap = out.scores.empty() ? 1 : out.scores.back().count;
  for (std::size_t i = 0; i + 1 < out.scores.size(); ++i) {
    if (out.scores[i].gap >= out.scores[i + 1].gap - out.scores[i + 1].gap_sigma) {
      out.by_gap = out.scores[i].count;
      break;
    }
  }
  return out;
}

std::vector<Merge> dendrogram(const Eigen::MatrixXd& items) {
  const int n = static_cast<int>(items.rows());
  Eigen::MatrixXd d = distances(items);
  std::vector<int> id(static_cast<std::size_t>(n));
  std::vector<int> size(static_cast<std::size_t>(n), 1);
  for (int i = 0; i < n; ++i) id[i] = i;
  std::vector<Merge> merges;
  for (int step = 0; step + 1 < n; ++step) {
    int a = -1;
    int b = -1;
    for (int i = 0; i < n; ++i) {
      if (size[i] == 0) continue;
      for (int j = i + 1; j < n; ++j) {
        if (size[j] > 0 && (a < 0 || d(i, j) < d(a, b))) {
          a = i;
          b = j;
        }
      }
    }
    merges.push_back({std::min(id[a], id[b]), std::max(id[a], id[b]), d(a, b), size[a] + size[b]});
    for (int k = 0; k < n; ++k) {
      if (k == a || k == b || size[k] == 0) continue;
      d(a, k) = d(k, a) = (size[a] * d(a, k) + size[b] * d(b, k)) / (size[a] + size[b]);
    }
    size[a] += size[b];
    size[b] = 0;
    id[a] = n + step;
  }
  return merges;
}

}  // namespace zerodrift::analysis
