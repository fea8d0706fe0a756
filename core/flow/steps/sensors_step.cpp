#include "core/flow/steps/sensors_step.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/analysis/clustering.h"
#include "core/analysis/sensor_choice.h"
#include "core/analysis/training.h"
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
  // What the fit gets when nobody says: the set with the least error to expect, which need not be the published one.
  ZD_TRY(const auto training, analysis::make_training({run}, {}));
  analysis::ChoiceOptions choice_options;
  choice_options.sensitive_points = clusters.sensitive_points;
  choice_options.few = clusters.sensitive_points.size();
  ZD_TRY(const auto choice, analysis::choose_sensor_set(training, choice_options, context));
  const auto& best = choice.sets[choice.chosen];
  const auto& chosen = options.chosen.empty() ? best.sensors : options.chosen;
  for (const auto& one : chosen) ZD_CHECK(run.require(one).map([](auto) {}));
  body["choice"] = analysis::to_json(choice);
  body["chosen"] = chosen;
  body["chosen_by"] = options.chosen.empty() ? std::string(analysis::name_of(best.kind)) : "hand";
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
