#include "core/flow/steps/sensors_step.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/analysis/clustering.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using nlohmann::json;

Result<commissioning::NewArtefact> choose_sensors(const commissioning::Job& job, const SensorsOptions& options,
                                                  const TaskContext& context) {
  ZD_TRY(const Input warmup, need(job, "sensors", "warmup"));
  ZD_TRY(const auto run, run_of(job, warmup));
  ZD_TRY(const auto profile, profile_of(job, "sensors"));
  analysis::ClusterOptions cluster_options;
  cluster_options.clusters = options.clusters;
  ZD_TRY(const auto clusters, analysis::cluster(run, cluster_options, context));
  json body = analysis::to_json(clusters);
  const auto& chosen = options.chosen.empty() ? clusters.sensitive_points : options.chosen;
  for (const auto& one : chosen) ZD_CHECK(run.require(one).map([](auto) {}));
  body["chosen"] = chosen;
  body["chosen_by"] = options.chosen.empty() ? "clustering" : "hand";
  json table = json::array();
  for (const auto& sensor : clusters.sensors) {
    std::string label;
    for (const auto& known : profile.sensors) {
      if (known.channel == sensor.sensor) label = known.label;
    }
    table.push_back({{"channel", sensor.sensor},
                     {"label", label},
                     {"cluster", sensor.cluster + 1},
                     {"correlation_sum", clusters.absolute_criterion ? sensor.absolute_sum : sensor.signed_sum},
                     {"kept", std::find(chosen.begin(), chosen.end(), sensor.sensor) != chosen.end()}});
  }
  body["table"] = table;
  return commissioning::NewArtefact::of("sensors", body, {warmup.id});
}

}  // namespace zerodrift::flow
