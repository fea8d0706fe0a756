#include "core/diagnosis/experiment.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/diagnosis/explain.h"

namespace zerodrift::diagnosis {
namespace {

struct Step {
  double minutes;
  double speed_share;  // of full speed
  bool coolant;
  double load_W;
};

struct Run {
  std::string id;
  std::vector<Step> steps;

  double minutes() const {
    double sum = 0.0;
    for (const auto& step : steps) sum += step.minutes;
    return sum;
  }
};

constexpr double longest_min = 240.0;

/// Runs of some shape, each in several lengths, shortest first: what separates two effects is the shape, how long it
/// has to be depends on how far apart they are.
std::vector<Run> runs_to_choose_from() {
  static const std::vector<Run> shapes = {
      {"heat_and_stop", {{60, 1.0, false, 0}, {60, 0.0, false, 0}}},
      {"coolant_once", {{50, 0.67, false, 0}, {40, 0.67, true, 0}, {30, 0.0, false, 0}}},
      {"half_speed", {{120, 0.5, false, 0}}},
      {"staircase", {{30, 0.25, false, 0}, {30, 0.5, false, 0}, {30, 0.75, false, 0}, {30, 1.0, false, 0}}},
      {"start_stop", {{30, 1.0, false, 0}, {30, 0.0, false, 0}, {30, 1.0, false, 0}, {30, 0.0, false, 0}}},
      {"coolant_toggle", {{30, 1.0, false, 0}, {30, 1.0, true, 0}, {30, 1.0, false, 0}, {30, 1.0, true, 0}}},
      {"hot_and_cold", {{20, 0.5, false, 0}, {60, 1.0, false, 0}, {20, 0.5, false, 0}, {20, 0.0, false, 0}}},
      {"cutting_toggle", {{30, 0.5, false, 0}, {30, 0.5, false, 2000}, {30, 0.5, false, 0}, {30, 0.5, false, 2000}}}};
  std::vector<Run> runs;
  for (const double share : {0.25, 0.35, 0.5, 0.7, 1.0, 1.4, 2.0}) {
    for (Run run : shapes) {
      for (Step& step : run.steps) step.minutes = std::round(step.minutes * share);
      if (run.minutes() <= longest_min) runs.push_back(std::move(run));
    }
  }
  std::stable_sort(runs.begin(), runs.end(), [](const Run& a, const Run& b) { return a.minutes() < b.minutes(); });
  return runs;
}

std::string words_of(const Run& run, double full_rpm) {
  std::string text;
  for (const Step& step : run.steps) {
    if (!text.empty()) text += "; ";
    const double rpm = std::round(step.speed_share * full_rpm);
    if (rpm <= 0.0) {
      text += fmt::format("{:.0f} min at rest", step.minutes);
    } else if (step.coolant) {
      text += fmt::format("{:.0f} min at {:.0f} rpm with coolant", step.minutes, rpm);
    } else if (step.load_W > 0.0) {
      text += fmt::format("{:.0f} min at {:.0f} rpm while cutting", step.minutes, rpm);
    } else {
      text += fmt::format("{:.0f} min at {:.0f} rpm", step.minutes, rpm);
    }
  }
  return text;
}

/// Load of the spindle while it only turns, W per rpm, as the recording has it: the least that was measured there.
double idle_load_W_rpm(const recording::Recording& seen) {
  const recording::Channel* load = seen.find("spindle_load_W");
  const recording::Channel* speed = seen.find("spindle_rpm");
  if (load == nullptr || speed == nullptr) return 0.0;
  std::vector<double> ratios;
  for (std::size_t k = 0; k < seen.rows(); ++k) {
    if (speed->values[k] > 1.0 && std::isfinite(load->values[k])) ratios.push_back(load->values[k] / speed->values[k]);
  }
  if (ratios.empty()) return 0.0;
  const auto low = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 10);
  std::nth_element(ratios.begin(), low, ratios.end());
  return std::max(0.0, *low);
}

recording::Recording inputs_of(const Run& run, const Model& model) {
  recording::Recording r;
  r.name = run.id;
  recording::Channel rpm{"spindle_rpm", {}}, coolant{"coolant_on", {}}, load{"spindle_load_W", {}};
  const double full_rpm = model.network().full_speed_rpm;
  const double idle_W_rpm = idle_load_W_rpm(*model.data().recording);
  double start_s = 0.0;
  for (const auto& step : run.steps) {
    for (double t = start_s; t < start_s + 60.0 * step.minutes - 1.0; t += 60.0) {
      r.time_s.push_back(t);
      rpm.values.push_back(step.speed_share * full_rpm);
      coolant.values.push_back(step.coolant ? 1.0 : 0.0);
      load.values.push_back(step.load_W + idle_W_rpm * rpm.values.back());
    }
    start_s = r.time_s.back() + 60.0;
  }
  const physics::Room& room = model.machine().room;
  double air_C = 20.0;
  if (!room.channel.empty()) {
    if (const auto* seen = model.data().recording->find(room.channel)) {
      air_C = recording::value_at(*model.data().recording, *seen, model.data().time_s.front());
    }
    r.channels.push_back({room.channel, std::vector<double>(r.rows(), air_C)});
  }
  // The run begins cold: every sensor at the room's temperature.
  for (const MeasuredChannel& channel : model.data().channels) {
    if (channel.temperature && channel.samples > 0) {
      r.channels.push_back({channel.name, std::vector<double>(r.rows(), air_C)});
    }
  }
  r.channels.insert(r.channels.end(), {rpm, coolant, load});
  return r;
}

nlohmann::json plan_of(const Run& run, double full_rpm) {
  nlohmann::json plan = {{"name", run.id},
                         {"sample_period_s", 10},
                         {"measure_period_s", 60},
                         {"measure_position_mm", {{"X", 0}, {"Y", 0}, {"Z", 0}}}};
  for (const auto& step : run.steps) {
    plan["steps"].push_back({{"duration_s", std::round(60.0 * step.minutes)},
                             {"spindle_rpm", std::round(step.speed_share * full_rpm)},
                             {"coolant_on", step.coolant},
                             {"path", "still"}});
    if (step.load_W > 0.0) plan["steps"].back()["spindle_load_W"] = step.load_W;
  }
  return plan;
}

/// What a model expects of a run and how its unknowns could bend that, whitened by the noise of the recording so far.
struct Expectation {
  physics::Prediction values;
  RowMatrix columns;          // by standardised unknowns
  Eigen::MatrixXd precision;  // of the unknowns after the first recording; what is new in each recording at its prior
};

/// The channels of the recording as they would be measured in the run: zeros with their noise.
Dataset channels_in(const recording::Recording& inputs, const Dataset& seen) {
  Dataset data;
  data.time_s = inputs.time_s;
  for (MeasuredChannel channel : seen.channels) {
    channel.values.assign(data.rows(), 0.0);
    channel.timing.assign(data.rows(), 0.0);
    channel.present.assign(data.rows(), channel.samples > 0);
    if (channel.samples > 0) channel.samples = static_cast<int>(data.rows());
    data.channels.push_back(std::move(channel));
  }
  data.prepare();
  return data;
}

Expectation expectation_of(const Model& model, const recording::Recording& inputs) {
  const physics::Network network = physics::build_network(model.machine(), inputs);
  std::vector<double> values = network.start_values();
  std::vector<int> parameters;
  std::vector<double> slopes;
  Expectation expected;
  expected.precision = model.hessian();
  const bool same = network.parameters.size() == model.network().parameters.size();
  for (std::size_t i = 0; same && i < model.unknowns(); ++i) {
    const physics::Parameter& unknown = model.unknown(i);
    const auto at = static_cast<std::size_t>(&unknown - model.network().parameters.data());
    if (network.parameters[at].key != unknown.key) continue;
    if (!unknown.per_recording) values[at] = model.value(i);
    parameters.push_back(static_cast<int>(at));
    slopes.push_back(unknown.slope_at(values[at]));
    if (!unknown.per_recording) continue;
    const auto row = static_cast<Eigen::Index>(i);
    expected.precision.row(row).setZero();
    expected.precision.col(row).setZero();
    expected.precision(row, row) = 1.0;
  }
  if (parameters.size() != model.unknowns()) parameters.clear();
  expected.values = physics::predict(network, physics::make_inputs(network, inputs), values, parameters);
  if (expected.values.channels.size() != model.data().channels.size()) return expected;
  const Dataset data = channels_in(inputs, model.data());
  expected.columns.setZero(static_cast<Eigen::Index>(data.stacked()), static_cast<Eigen::Index>(parameters.size()));
  std::vector<int> targets(parameters.size());
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i] = static_cast<int>(i);
  if (!targets.empty()) whiten_columns(data, expected.values, slopes, expected.columns, targets);
  return expected;
}

/// What two models expect differently, in noise widths; empty where they do not see the same channels.
Eigen::VectorXd difference_of(const Expectation& a, const Expectation& b, Dataset data) {
  if (a.values.channels.size() != data.channels.size() || b.values.channels.size() != data.channels.size()) return {};
  for (std::size_t c = 0; c < data.channels.size(); ++c) data.channels[c].values = a.values.channels[c].values;
  Eigen::VectorXd difference;
  whiten(data, b.values, &difference);
  return difference;
}

/// Expected log evidence against a model if the difference is true: what its unknowns cannot absorb.
/// delta' (I + J H^-1 J')^-1 delta / 2 by Woodbury.
double evidence_against(const Expectation& model, const Eigen::VectorXd& difference) {
  double left = difference.squaredNorm();
  if (model.columns.cols() > 0) {
    const Eigen::VectorXd b = model.columns.transpose() * difference;
    const Eigen::MatrixXd h = model.precision + model.columns.transpose() * model.columns;
    left -= b.dot(h.ldlt().solve(b));
  }
  return 0.5 * std::max(0.0, left);
}

struct Separation {
  double evidence = 0.0;  // the least over the rivals
  const Model* nearest = nullptr;
};

Separation separation_by(const Run& run, const Model& best, const std::vector<const Model*>& rivals) {
  const recording::Recording inputs = inputs_of(run, best);
  const Expectation expected = expectation_of(best, inputs);
  const Dataset data = channels_in(inputs, best.data());
  Separation separation{1e300, nullptr};
  for (const Model* rival : rivals) {
    const Expectation other = expectation_of(*rival, inputs);
    const Eigen::VectorXd difference = difference_of(expected, other, data);
    if (difference.size() == 0) continue;
    const double apart = std::min(evidence_against(expected, difference), evidence_against(other, difference));
    if (apart < separation.evidence) separation = {apart, rival};
  }
  return separation;
}

}  // namespace

SuggestedExperiment suggest_experiment(const Model& best, const std::vector<const Model*>& rivals) {
  constexpr double decisive = 40.0;  // log evidence expected: then more hours buy nothing
  constexpr double as_short = 1.1;   // lengths that are called alike
  SuggestedExperiment suggestion;
  double decided_min = 1e300;
  for (const Run& run : runs_to_choose_from()) {
    if (run.minutes() > as_short * decided_min) break;
    const Separation separation = separation_by(run, best, rivals);
    if (separation.nearest == nullptr || separation.evidence <= suggestion.distance) continue;
    if (separation.evidence > decisive) decided_min = std::min(decided_min, run.minutes());
    suggestion.distance = separation.evidence;
    suggestion.id = run.id;
    const double full_rpm = best.network().full_speed_rpm;
    suggestion.plan_json = plan_of(run, full_rpm).dump();
    // A best model without any effect: nothing is missing, or the rival is.
    const auto& effects = best.machine().effects;
    const bool named = !effects.empty() && effects.back().candidate;
    suggestion.text = explain_experiment(named ? effects.back().id : std::string(),
                                         separation.nearest->machine().effects.back().id, words_of(run, full_rpm));
  }
  return suggestion;
}

}  // namespace zerodrift::diagnosis
