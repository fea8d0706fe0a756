#include "core/analysis/clustering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/analysis/prepare.h"
#include "core/analysis/statistics.h"
#include "core/base/noise.h"

namespace zerodrift::analysis {
namespace {

/// Items (sensors) by points of time, in the chosen measure of distance.
Eigen::MatrixXd items_of(const Eigen::MatrixXd& temperature_C, Distance distance) {
  Eigen::MatrixXd items = temperature_C.transpose();
  if (distance == Distance::rise) items = items.colwise() - Eigen::VectorXd(items.col(0));
  if (distance == Distance::standardised) {
    for (Eigen::Index i = 0; i < items.rows(); ++i) {
      items.row(i).array() -= items.row(i).mean();
      const double deviation = std::sqrt(items.row(i).squaredNorm() / static_cast<double>(items.cols()));
      if (deviation > 0.0) items.row(i) /= deviation;
    }
  }
  return items;
}

void correlate(const Samples& measured, double grid_s, ClusterAnalysis& out) {
  const double span_s = measured.time_s.back() - measured.time_s.front();
  for (std::size_t s = 0; s < out.sensors.size(); ++s) {
    SensorFacts& facts = out.sensors[s];
    const Eigen::VectorXd t = measured.temperature_C.col(static_cast<Eigen::Index>(s));
    for (Eigen::Index e = 0; e < measured.error_um.cols(); ++e) {
      const Eigen::VectorXd error = measured.error_um.col(e);
      const double r = pearson(t, error);
      facts.correlation.push_back(r);
      facts.signed_sum += r;
      facts.absolute_sum += std::abs(r);
      facts.lag_s.push_back(lag_s(measured.time_s, t, error, grid_s, std::min(7200.0, 0.25 * span_s)));
    }
    facts.range_K = t.maxCoeff() - t.minCoeff();
  }
}

double sum_of(const SensorFacts& facts, bool absolute) {
  return absolute ? facts.absolute_sum : facts.signed_sum;
}

/// Whether correlations of opposite signs cancel in the published sum: then it favours the sensors that say least.
void choose_criterion(SumCriterion wanted, ClusterAnalysis& out) {
  double cancelled = 0.0;
  double best_absolute = 0.0;
  for (const auto& facts : out.sensors) {
    if (facts.absolute_sum > best_absolute) {
      best_absolute = facts.absolute_sum;
      cancelled = facts.absolute_sum - facts.signed_sum;
    }
  }
  const bool signs_cancel = cancelled > 0.2 * best_absolute;
  out.absolute_criterion = wanted == SumCriterion::absolute_sum || (wanted == SumCriterion::automatic && signs_cancel);
  if (wanted != SumCriterion::automatic) {
    out.criterion_reason = "as asked for";
  } else if (signs_cancel) {
    out.criterion_reason =
        fmt::format("the errors move in opposite directions: {:.2f} of the best sensor's {:.2f} would cancel",
                    cancelled, best_absolute);
  } else {
    out.criterion_reason = "the errors move in one direction, so signs cannot cancel";
  }
}

std::vector<std::string> largest_of_each(const ClusterAnalysis& analysis, bool absolute) {
  std::vector<std::string> out;
  for (Eigen::Index k = 0; k < analysis.clustering.centres.rows(); ++k) {
    const SensorFacts* best = nullptr;
    for (const auto& facts : analysis.sensors) {
      if (facts.cluster != k) continue;
      if (best == nullptr || sum_of(facts, absolute) > sum_of(*best, absolute)) best = &facts;
    }
    out.push_back(best == nullptr ? std::string{} : best->sensor);
  }
  return out;
}

/// Mean adjusted Rand index between this partition and those of runs resampled in blocks of a tenth of the run.
double stability_of(const Eigen::MatrixXd& items, const Clustering& own, int first_item, std::uint64_t seed) {
  constexpr int resamples = 40;
  const Eigen::Index block = std::max<Eigen::Index>(items.cols() / 10, 1);
  Noise noise(seed + 104729);
  double sum = 0.0;
  for (int r = 0; r < resamples; ++r) {
    Eigen::MatrixXd resampled(items.rows(), items.cols());
    for (Eigen::Index c = 0; c < items.cols(); c += block) {
      const auto from = static_cast<Eigen::Index>(noise.index(static_cast<std::uint64_t>(items.cols() - block + 1)));
      const Eigen::Index width = std::min(block, items.cols() - c);
      resampled.middleCols(c, width) = items.middleCols(from, width);
    }
    const Clustering c = kmeans_plus_plus(resampled, static_cast<int>(own.centres.rows()), first_item,
                                          seed + static_cast<std::uint64_t>(r));
    sum += adjusted_rand(own.cluster_of, c.cluster_of) / resamples;
  }
  return sum;
}

void describe_sensors(const Eigen::MatrixXd& items, const PrincipalComponents& pc, const Samples& series,
                      ClusterAnalysis& out) {
  const std::vector<double> silhouette = silhouettes(items, out.clustering.cluster_of);
  const Eigen::VectorXd vif = variance_inflation(series.temperature_C);
  for (std::size_t s = 0; s < out.sensors.size(); ++s) {
    const auto i = static_cast<Eigen::Index>(s);
    out.sensors[s].cluster = out.clustering.cluster_of[s];
    out.sensors[s].silhouette = silhouette[s];
    out.sensors[s].vif = vif(i);
    out.sensors[s].pc1 = pc.scores(i, 0);
    out.sensors[s].pc2 = pc.scores(i, 1);
  }
  out.explained.assign(pc.explained.begin(), pc.explained.end());
}

void mark_sensitive(const Samples& series, ClusterAnalysis& out) {
  out.sensitive_points_signed = largest_of_each(out, false);
  out.sensitive_points_absolute = largest_of_each(out, true);
  out.sensitive_points = out.absolute_criterion ? out.sensitive_points_absolute : out.sensitive_points_signed;
  Eigen::MatrixXd kept(series.temperature_C.rows(), static_cast<Eigen::Index>(out.sensitive_points.size()));
  Eigen::Index column = 0;
  for (std::size_t s = 0; s < out.sensors.size(); ++s) {
    const auto& points = out.sensitive_points;
    if (std::find(points.begin(), points.end(), out.sensors[s].sensor) == points.end()) continue;
    out.sensors[s].sensitive = true;
    kept.col(column++) = series.temperature_C.col(static_cast<Eigen::Index>(s));
  }
  out.condition_all = condition_number(series.temperature_C);
  out.condition_sensitive = condition_number(kept.leftCols(column));
}

}  // namespace

Result<ClusterAnalysis> cluster(const recording::Recording& recording, const ClusterOptions& options,
                                const TaskContext& context) {
  PrepareOptions prepare_options;
  prepare_options.errors = options.errors;
  ZD_TRY(const Prepared data, prepare(recording, prepare_options));
  const int sensors = static_cast<int>(data.sensors.size());
  if (options.clusters < 0 || options.clusters > sensors) {
    return fail(ErrorCode::bad_argument, {{"what", "the number of clusters"},
                                          {"found", std::to_string(options.clusters)},
                                          {"expected", fmt::format("1 to {} (usable sensors), or auto", sensors)}});
  }
  ClusterAnalysis out;
  out.recording = recording.name;
  out.errors = data.errors;
  out.distance = options.distance;
  out.seed = options.seed;
  out.findings = data.findings;
  for (const auto& name : data.sensors) out.sensors.emplace_back().sensor = name;
  const Samples measured = sample(data, true);
  const Samples series = sample(data, false);
  correlate(measured, block_length_s(data), out);
  choose_criterion(options.criterion, out);
  context.progress(0.2, "clustering");

  const Eigen::MatrixXd items = items_of(series.temperature_C, options.distance);
  const PrincipalComponents pc = principal_components(items);
  if (options.suggest || options.clusters == 0) out.suggestion = suggest_count(pc.scores, 10, options.seed);
  if (context.cancelled()) return fail(ErrorCode::cancelled);
  int first = 0;
  for (int s = 1; s < sensors; ++s) {
    if (sum_of(out.sensors[s], out.absolute_criterion) > sum_of(out.sensors[first], out.absolute_criterion)) first = s;
  }
  out.seed_sensor = data.sensors[static_cast<std::size_t>(first)];
  const int count = options.clusters > 0 ? options.clusters : std::min(out.suggestion.by_silhouette, sensors);
  out.clustering = kmeans_plus_plus(items, count, first, options.seed);
  if (options.stability) out.stability = stability_of(items, out.clustering, first, options.seed);
  describe_sensors(items, pc, series, out);
  mark_sensitive(series, out);
  for (const int s : spread_of(series.temperature_C)) {
    out.spread_order.push_back(data.sensors[static_cast<std::size_t>(s)]);
  }
  out.merges = dendrogram(items);
  context.progress(1.0, "clustering");
  return out;
}

std::string_view name_of(Distance distance) {
  switch (distance) {
    case Distance::raw:
      return "raw";
    case Distance::rise:
      return "rise";
    case Distance::standardised:
      return "standardised";
  }
  return "";
}

}  // namespace zerodrift::analysis
