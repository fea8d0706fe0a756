#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/analysis/clustering.h"

namespace zerodrift::analysis {
namespace {

using nlohmann::json;

json sensor_json(const SensorFacts& facts, const std::vector<std::string>& errors) {
  json correlation = json::object();
  json lag = json::object();
  for (std::size_t e = 0; e < errors.size(); ++e) {
    correlation[errors[e]] = facts.correlation[e];
    lag[errors[e]] = facts.lag_s[e];
  }
  return {{"sensor", facts.sensor},         {"cluster", facts.cluster + 1},
          {"sensitive", facts.sensitive},   {"correlation", std::move(correlation)},
          {"sum", facts.signed_sum},        {"sum_absolute", facts.absolute_sum},
          {"lag_s", std::move(lag)},        {"vif", facts.vif},
          {"silhouette", facts.silhouette}, {"range_K", facts.range_K},
          {"pc", {facts.pc1, facts.pc2}}};
}

json clusters_json(const ClusterAnalysis& analysis) {
  json list = json::array();
  for (std::size_t k = 0; k < analysis.sensitive_points.size(); ++k) {
    json members = json::array();
    double silhouette = 0.0;
    for (const auto& facts : analysis.sensors) {
      if (facts.cluster != static_cast<int>(k)) continue;
      members.push_back(facts.sensor);
      silhouette += facts.silhouette;
    }
    const auto size = static_cast<double>(std::max<std::size_t>(members.size(), 1));
    list.push_back({{"id", k + 1},
                    {"sensors", std::move(members)},
                    {"sensitive_point", analysis.sensitive_points[k]},
                    {"silhouette", silhouette / size}});
  }
  return list;
}

}  // namespace

nlohmann::json to_json(const ClusterAnalysis& analysis) {
  json sensors = json::array();
  for (const auto& facts : analysis.sensors) sensors.push_back(sensor_json(facts, analysis.errors));
  json table = json::array();
  for (const auto& s : analysis.suggestion.scores) {
    table.push_back({{"clusters", s.count}, {"silhouette", s.silhouette}, {"gap", s.gap}, {"gap_sigma", s.gap_sigma}});
  }
  json merges = json::array();
  for (const auto& m : analysis.merges) {
    merges.push_back({{"a", m.a}, {"b", m.b}, {"height", m.height}, {"size", m.size}});
  }
  return {{"format", "zerodrift-clusters/1"},
          {"recording", analysis.recording},
          {"errors", analysis.errors},
          {"distance", name_of(analysis.distance)},
          {"seed", analysis.seed},
          {"seed_sensor", analysis.seed_sensor},
          {"iterations", analysis.clustering.iterations},
          {"inertia", analysis.clustering.inertia},
          {"criterion",
           {{"used", analysis.absolute_criterion ? "absolute" : "signed"}, {"why", analysis.criterion_reason}}},
          {"sensitive_points", analysis.sensitive_points},
          {"sensitive_points_signed", analysis.sensitive_points_signed},
          {"sensitive_points_absolute", analysis.sensitive_points_absolute},
          {"spread_order", analysis.spread_order},
          {"clusters", clusters_json(analysis)},
          {"sensors", std::move(sensors)},
          {"suggested_clusters",
           {{"silhouette", analysis.suggestion.by_silhouette},
            {"gap", analysis.suggestion.by_gap},
            {"table", std::move(table)}}},
          {"stability", analysis.stability},
          {"explained_variance", analysis.explained},
          {"dendrogram", std::move(merges)},
          {"condition_number", {{"all", analysis.condition_all}, {"sensitive", analysis.condition_sensitive}}},
          {"findings", to_json(analysis.findings)}};
}

}  // namespace zerodrift::analysis
