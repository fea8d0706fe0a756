#pragma once
// Thermally sensitive points (S1, S2): sensors grouped by the likeness of their temperature series, and in each group
// the one that goes best with the errors.
//
// clusters.json ("zerodrift-clusters/1"):
//   recording, errors [names], distance "raw|rise|standardised", seed, seed_sensor, iterations, inertia,
//   criterion {used "signed|absolute", why}, sensitive_points [one a cluster], sensitive_points_signed, ..._absolute,
//   spread_order (all sensors, each saying most that those before it do not: its first five suit a static model),
//   clusters [{id from 1, sensors, sensitive_point, silhouette}],
//   sensors [{sensor, cluster, sensitive, correlation {error: r}, sum, sum_absolute, lag_s {error: s}, vif, silhouette,
//             range_K, pc [first, second principal component]}],
//   suggested_clusters {silhouette, gap, table [{clusters, silhouette, gap, gap_sigma}]}, stability (mean adjusted Rand
//   index under resampling of the run), explained_variance [shares of pc], dendrogram [{a, b, height, size}] (items
//   0..n-1 in the order of sensors, merges from n on), condition_number {all, sensitive}, findings [...].

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/analysis/findings.h"
#include "core/analysis/kmeans.h"
#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/recording/recording.h"

namespace zerodrift::analysis {

enum class Distance {
  raw,           // temperatures as they are: groups by level and by shape (as published)
  rise,          // rise over the first sample: constant offsets between sensors do not count
  standardised,  // each series to mean 0, deviation 1: groups by shape alone
};

enum class SumCriterion {
  automatic,  // signed as published, absolute when the errors of the run have opposite signs
  signed_sum,
  absolute_sum,
};

struct ClusterOptions {
  int clusters = 5;                 // 0: as suggested by the silhouette
  std::vector<std::string> errors;  // empty: all of the recording
  Distance distance = Distance::raw;
  SumCriterion criterion = SumCriterion::automatic;
  std::uint64_t seed = 1;
  bool suggest = true;    // also try every number of clusters
  bool stability = true;  // also resample the run
};

struct SensorFacts {
  std::string sensor;
  int cluster = 0;  // 0-based
  bool sensitive = false;
  std::vector<double> correlation;  // with each error
  std::vector<double> lag_s;        // behind each error; positive: the sensor follows later
  double signed_sum = 0.0;
  double absolute_sum = 0.0;
  double vif = 1.0;
  double silhouette = 0.0;
  double range_K = 0.0;
  double pc1 = 0.0;
  double pc2 = 0.0;
};

struct ClusterAnalysis {
  std::string recording;
  std::vector<std::string> errors;
  Distance distance = Distance::raw;
  std::uint64_t seed = 1;
  std::string seed_sensor;
  bool absolute_criterion = false;
  std::string criterion_reason;
  Clustering clustering;
  std::vector<SensorFacts> sensors;
  std::vector<std::string> sensitive_points;  // one for each cluster, in cluster order
  std::vector<std::string> sensitive_points_signed;
  std::vector<std::string> sensitive_points_absolute;
  std::vector<std::string> spread_order;  // sensors, each saying most that those before it do not (statistics.h)
  CountSuggestion suggestion;
  double stability = 0.0;
  std::vector<double> explained;
  std::vector<Merge> merges;
  double condition_all = 1.0;
  double condition_sensitive = 1.0;
  std::vector<Finding> findings;
};

Result<ClusterAnalysis> cluster(const recording::Recording& recording, const ClusterOptions& options = {},
                                const TaskContext& context = {});
nlohmann::json to_json(const ClusterAnalysis& analysis);
std::string_view name_of(Distance distance);

}  // namespace zerodrift::analysis
