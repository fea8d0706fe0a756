#include "core/flow/steps/sensors_step.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "core/acquisition/happening.h"
#include "core/analysis/budget.h"
#include "core/analysis/clustering.h"
#include "core/analysis/evaluate.h"
#include "core/analysis/sensor_choice.h"
#include "core/analysis/statistics.h"
#include "core/analysis/training.h"
#include "core/flow/steps/inputs.h"
#include "core/flow/steps/recordings_step.h"
#include "core/report/limits.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

constexpr auto judged_by = analysis::Method::ridge;  // what a controller's table is fitted with
constexpr int longest_budget = 12;
/// More leave little less on what was seen (0.05 um rms of 0.5), cost a cable each and fill the controller: the
/// engineer may still take all.
constexpr std::size_t most_sensors = 8;
/// One cycle does not say which bodies matter at other speeds: more of them keep a sensor.
constexpr std::size_t most_of_one_cycle = 12;

/// So little more error is no reason for another cable.
constexpr double flat_um = 0.05;

using Names = std::vector<std::string>;

struct Thinned {
  Names kept;
  Names left;            // that the curve is flat without
  double cost_um = 0.0;  // of leaving them, in error to expect
};

/// The sensor that is missed least goes, and so on, as long as the error to expect stays within flat_um of the whole
/// set's; `fewest` stay, so that each cluster of bodies may keep one.
Result<Thinned> thinned(const analysis::TrainingSet& training, const analysis::SensorSet& whole, std::size_t fewest,
                        const TaskContext& context) {
  Thinned out{whole.sensors, {}, 0.0};
  while (out.kept.size() > fewest) {
    std::size_t least = 0;
    double least_um = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < out.kept.size(); ++i) {
      Names tried = out.kept;
      tried.erase(tried.begin() + static_cast<std::ptrdiff_t>(i));
      const auto recipe = analysis::make_recipe(judged_by, tried, training);
      ZD_TRY(const auto judged, analysis::evaluate(training, recipe, 0.9, context));
      if (judged.expected_um >= least_um) continue;
      least = i;
      least_um = judged.expected_um;
    }
    if (least_um > whole.expected_um + flat_um) break;
    out.left.push_back(out.kept[least]);
    out.kept.erase(out.kept.begin() + static_cast<std::ptrdiff_t>(least));
    out.cost_um = least_um - whole.expected_um;
  }
  return out;
}

/// The largest set within limits::condition_number that is found by taking out, one after the other, the sensor without
/// which the fit is conditioned best.
struct WellConditioned {
  Names kept;
  Names left;
  double cost_um = 0.0;  // in error to expect, against the set it is of
};

Result<WellConditioned> well_conditioned(const analysis::TrainingSet& training, const Names& whole,
                                         const TaskContext& context) {
  WellConditioned out{whole, {}, 0.0};
  ZD_TRY(double condition, analysis::fitted_condition(training, out.kept));
  while (out.kept.size() > 1 && condition > report::limits::condition_number) {
    std::size_t least = 0;
    condition = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < out.kept.size(); ++i) {
      if (context.cancelled()) return fail(ErrorCode::cancelled);
      Names tried = out.kept;
      tried.erase(tried.begin() + static_cast<std::ptrdiff_t>(i));
      ZD_TRY(const double now, analysis::fitted_condition(training, tried));
      if (now >= condition) continue;
      condition = now;
      least = i;
    }
    out.left.push_back(out.kept[least]);
    out.kept.erase(out.kept.begin() + static_cast<std::ptrdiff_t>(least));
  }
  const auto expected_um = [&](const Names& sensors) {
    return analysis::evaluate(training, analysis::make_recipe(judged_by, sensors, training), 0.9, context)
        .map([](const auto& judged) { return judged.expected_um; });
  };
  ZD_TRY(const double before_um, expected_um(whole));
  ZD_TRY(const double after_um, expected_um(out.kept));
  out.cost_um = after_um - before_um;
  return out;
}

/// What the kept sensors leave on unseen stretches, what all would, and what each one is worth: kept, by how much the
/// error rises without it; left, by how much it changes with it.
Result<json> price_of(const analysis::TrainingSet& training, const Names& chosen, const TaskContext& context) {
  ZD_TRY(const auto now, analysis::price_set(training, judged_by, chosen, context));
  ZD_TRY(const auto all, analysis::price_set(training, judged_by, training.sensors, context));
  json prices = json::object();
  for (const auto& sensor : training.sensors) {
    Names other = chosen;
    const bool kept = std::erase(other, sensor) > 0;
    if (!kept) other.push_back(sensor);
    if (other.empty()) continue;
    ZD_TRY(const auto changed, analysis::price_set(training, judged_by, other, context));
    prices[sensor] = changed.held_out_rms_um - now.held_out_rms_um;
  }
  return json{{"held_out_rms_um", now.held_out_rms_um},
              {"held_out_peak_um", now.held_out_peak_um},
              {"all_rms_um", all.held_out_rms_um},
              {"change_um", std::move(prices)}};
}

Result<json> budget_of(const analysis::TrainingSet& training, const TaskContext& context) {
  ZD_TRY(const auto curve, analysis::budget_curve(training, judged_by, longest_budget, context));
  json list = json::array();
  for (const auto& point : curve) {
    list.push_back({{"sensors", point.sensors.size()},
                    {"added", point.sensors.back()},
                    {"held_out_rms_um", point.held_out_rms_um},
                    {"held_out_peak_um", point.held_out_peak_um}});
  }
  return list;
}

/// Sensors that the run named (stuck, dead, spiking, jumped, swapped), with what it said of them: none of these is
/// proposed.
std::map<std::string, std::string> named_by(const json& warmup) {
  std::map<std::string, std::string> named;
  const auto happened = warmup.find("happened");
  if (happened == warmup.end()) return named;
  for (const auto& one : acquisition::happenings_from_json(*happened)) {
    if (one.overcome || !one.name.starts_with("sensor_")) continue;
    const std::string fault = one.name.substr(std::string("sensor_").size());
    for (const auto& sensor : one.what) {
      std::string& said = named[sensor];
      said += (said.empty() ? "" : ", ") + fault;
    }
  }
  return named;
}

/// The run without these sensors.
recording::Recording without(recording::Recording run, const std::map<std::string, std::string>& left_out) {
  std::erase_if(run.channels, [&](const recording::Channel& channel) { return left_out.contains(channel.name); });
  return run;
}

/// Of the blocks of the first run, as the clustering states its own.
double condition_of(const analysis::TrainingSet& training, const Names& chosen) {
  const auto& samples = training.samples.front().temperature_C;
  Eigen::MatrixXd columns(samples.rows(), 0);
  for (const auto& sensor : chosen) {
    const int column = training.runs.front().sensor(sensor);
    if (column < 0) continue;
    columns.conservativeResize(Eigen::NoChange, columns.cols() + 1);
    columns.col(columns.cols() - 1) = samples.col(column);
  }
  return columns.cols() > 0 ? analysis::condition_number(columns) : 1.0;
}

}  // namespace

Result<commissioning::NewArtefact> choose_sensors(const commissioning::Job& job, const SensorsOptions& options,
                                                  const TaskContext& context) {
  ZD_TRY(const Input warmup, need(job, "sensors", "warmup"));
  ZD_TRY(const auto whole, run_of(job, warmup));
  const auto named = named_by(warmup.body);
  auto left_out = named;
  for (const auto& taken : options.chosen) left_out.erase(taken);  // by hand, against the advice
  const auto run = without(whole, left_out);
  ZD_TRY(const auto machine, job.latest("machine"));
  controller::Profile profile;  // of no machine when the run was imported: then the sensors have no labels
  if (machine) {
    ZD_TRY(profile, profile_of(job, "sensors"));
  }
  analysis::ClusterOptions cluster_options;
  cluster_options.clusters = options.clusters;
  auto clustered = analysis::cluster(run, cluster_options, context);
  if (!clustered && clustered.error().code == ErrorCode::bad_argument) {
    cluster_options.clusters = 0;  // fewer sensors than clusters: as many as suggested
    clustered = analysis::cluster(run, cluster_options, context);
  }
  ZD_TRY(const auto clusters, std::move(clustered));
  json body = analysis::to_json(clusters);
  // What the fit gets when nobody says: the set with the least error to expect, which need not be the published one.
  ZD_TRY(auto runs, training_runs(job, whole));
  for (auto& one : runs) one = without(std::move(one), left_out);
  ZD_TRY(const auto training, analysis::make_training(runs, {}));
  analysis::ChoiceOptions choice_options;
  choice_options.sensitive_points = clusters.sensitive_points;
  choice_options.few = clusters.sensitive_points.size();
  choice_options.most = std::max(training.folds.cycles < 2 ? most_of_one_cycle : most_sensors, choice_options.few);
  ZD_TRY(const auto choice, analysis::choose_sensor_set(training, choice_options, context));
  const auto& best = choice.sets[choice.chosen];
  // One cycle does not tell which sensor is idle: bodies that rose together in it need not do so at other speeds.
  Thinned proposed{best.sensors, {}, 0.0};
  if (options.chosen.empty() && !choice.one_cycle) {
    ZD_TRY(proposed, thinned(training, best, choice_options.few, context));
  }
  json condition = nullptr;
  ZD_TRY(const double proposed_condition, analysis::fitted_condition(training, proposed.kept));
  if (options.chosen.empty() && proposed_condition > report::limits::condition_number) {
    ZD_TRY(const auto tame, well_conditioned(training, proposed.kept, context));
    const bool too_few = tame.kept.size() < choice_options.few;  // each cluster of bodies may keep one
    const bool held = !choice.one_cycle && !too_few && tame.cost_um <= report::limits::lost_against_all_um;
    condition = {{"without", proposed_condition},
                 {"held", held},
                 {"fewer_than_clusters", too_few},
                 {"left", tame.left},
                 {"cost_um", tame.cost_um}};
    if (held) proposed.kept = tame.kept;
  }
  const auto& chosen = options.chosen.empty() ? proposed.kept : options.chosen;
  for (const auto& one : chosen) ZD_CHECK(run.require(one).map([](auto) {}));
  body["choice"] = analysis::to_json(choice);
  body["choice"]["one_cycle"] = choice.one_cycle;
  body["choice"]["flat"] = {{"left", proposed.left}, {"cost_um", proposed.cost_um}};
  body["choice"]["condition"] = condition;
  ZD_TRY(body["price"], price_of(training, chosen, context));
  ZD_TRY(body["budget"], budget_of(training, context));
  ZD_TRY(body["condition_number"]["chosen"], analysis::fitted_condition(training, chosen));
  body["condition_number"]["chosen_temperatures"] = condition_of(training, chosen);
  body["clusters_asked"] = cluster_options.clusters;
  body["chosen"] = chosen;
  body["chosen_by"] = options.chosen.empty() ? std::string(analysis::name_of(best.kind)) : "hand";
  const auto label_of = [&](const std::string& channel) -> std::string {
    for (const auto& known : profile.sensors) {
      if (known.channel == channel) return known.label;
    }
    return "";
  };
  json table = json::array();
  for (const auto& sensor : clusters.sensors) {
    table.push_back({{"channel", sensor.sensor},
                     {"label", label_of(sensor.sensor)},
                     {"note", named.contains(sensor.sensor) ? named.at(sensor.sensor) + " in the warm-up run" : ""},
                     {"cluster", sensor.cluster + 1},
                     {"correlation_sum", clusters.absolute_criterion ? sensor.absolute_sum : sensor.signed_sum},
                     {"kept", std::find(chosen.begin(), chosen.end(), sensor.sensor) != chosen.end()}});
  }
  body["table"] = table;
  body["left_out"] = json::array();
  for (const auto& [channel, fault] : left_out) {
    if (whole.find(channel) == nullptr) continue;
    body["left_out"].push_back({{"channel", channel},
                                {"label", label_of(channel)},
                                {"reason", fmt::format("{} in the warm-up run, so it is not proposed", fault)}});
  }
  return commissioning::NewArtefact::of("sensors", body, {warmup.id});
}

Result<SensorsOptions> sensors_asked_for(const commissioning::Job& job) {
  SensorsOptions options;
  ZD_TRY(const auto latest, job.latest("sensors"));
  if (!latest) return options;
  ZD_TRY(const json body, latest->document());
  if (!body.is_object()) return options;  // a job may come from elsewhere
  const auto found = static_cast<int>(body.value("clusters", json::array()).size());
  options.clusters = body.value("clusters_asked", found > 0 ? found : options.clusters);
  if (body.value("chosen_by", "") == "hand") options.chosen = body.value("chosen", std::vector<std::string>{});
  return options;
}

}  // namespace zerodrift::flow
