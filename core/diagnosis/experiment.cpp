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
  double hours;
  double speed_share;  // of full speed
  bool coolant;
  double load_W;
};

struct Run {
  const char* id;
  const char* text;
  std::vector<Step> steps;
};

/// From short to long.
const std::vector<Run>& library() {
  static const std::vector<Run> runs = {
      {"hour_and_stop",
       "full speed for 1 h without coolant, then stop and record 1 h of cooling",
       {{1.0, 1.0, false, 0}, {1.0, 0.0, false, 0}}},
      {"coolant_once",
       "two thirds of full speed for 50 min without coolant, 40 min with it, then stop and record 30 min",
       {{0.834, 0.67, false, 0}, {0.667, 0.67, true, 0}, {0.5, 0.0, false, 0}}},
      {"full_then_stop",
       "full speed for 2 h without coolant, then stop and record 1.5 h of cooling",
       {{2.0, 1.0, false, 0}, {1.5, 0.0, false, 0}}},
      {"half_speed", "half speed for 3 h without coolant", {{3.0, 0.5, false, 0}}},
      {"staircase",
       "25, 50, 75 and 100 % of full speed, 45 min each",
       {{0.75, 0.25, false, 0}, {0.75, 0.5, false, 0}, {0.75, 0.75, false, 0}, {0.75, 1.0, false, 0}}},
      {"start_stop",
       "full speed for 40 min and stop for 40 min, twice",
       {{0.667, 1.0, false, 0}, {0.667, 0.0, false, 0}, {0.667, 1.0, false, 0}, {0.667, 0.0, false, 0}}},
      {"coolant_toggle",
       "full speed for 2.7 h, coolant on and off every 40 min",
       {{0.667, 1.0, false, 0}, {0.667, 1.0, true, 0}, {0.667, 1.0, false, 0}, {0.667, 1.0, true, 0}}},
      {"hot_and_cold",
       "half speed for 20 min cold, full speed for 1.5 h, half speed for 20 min hot, stop for 40 min",
       {{0.334, 0.5, false, 0}, {1.5, 1.0, false, 0}, {0.334, 0.5, false, 0}, {0.667, 0.0, false, 0}}},
      {"cutting_toggle",
       "half speed for 2.7 h, cutting on and off every 40 min",
       {{0.667, 0.5, false, 0}, {0.667, 0.5, false, 2000}, {0.667, 0.5, false, 0}, {0.667, 0.5, false, 2000}}}};
  return runs;
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
    for (double t = start_s; t < start_s + 3600.0 * step.hours - 1.0; t += 60.0) {
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

double hours_of(const Run& run) {
  double sum = 0.0;
  for (const auto& step : run.steps) sum += step.hours;
  return sum;
}

nlohmann::json plan_of(const Run& run, double full_rpm) {
  nlohmann::json plan = {{"name", run.id},
                         {"sample_period_s", 10},
                         {"measure_period_s", 60},
                         {"measure_position_mm", {{"X", 0}, {"Y", 0}, {"Z", 0}}}};
  for (const auto& step : run.steps) {
    plan["steps"].push_back({{"duration_s", std::round(3600.0 * step.hours)},
                             {"spindle_rpm", std::round(step.speed_share * full_rpm)},
                             {"coolant_on", step.coolant},
                             {"path", "still"}});
    if (step.load_W > 0.0) plan["steps"].back()["spindle_load_W"] = step.load_W;
  }
  return plan;
}

/// What a model expects of a run, in noise widths at samples that are independent of each other (neighbours share the
/// slow drift: one in 15 minutes), and how its unknowns could bend that.
struct Expectation {
  Eigen::VectorXd values;
  Eigen::MatrixXd columns;    // by standardised unknowns
  Eigen::MatrixXd precision;  // of the unknowns after the first recording; what is new in each recording at its prior
};

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
  const bool whole = parameters.size() == model.unknowns();
  if (!whole) parameters.clear();
  const physics::Prediction prediction =
      physics::predict(network, physics::make_inputs(network, inputs), values, parameters);
  constexpr std::size_t stride = 15;
  const std::size_t per_channel = (prediction.rows + stride - 1) / stride;
  expected.values.setZero(static_cast<Eigen::Index>(per_channel * prediction.channels.size()));
  expected.columns.setZero(expected.values.size(), static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t c = 0; c < prediction.channels.size() && c < model.data().channels.size(); ++c) {
    const MeasuredChannel& channel = model.data().channels[c];
    if (channel.samples == 0) continue;
    const double sigma = std::hypot(channel.drift, channel.white / 4.0);
    for (std::size_t k = 0; k < prediction.rows; k += stride) {
      const auto row = static_cast<Eigen::Index>(c * per_channel + k / stride);
      expected.values[row] = prediction.channels[c].values[k] / sigma;
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        expected.columns(row, static_cast<Eigen::Index>(p)) =
            prediction.channels[c].derivatives[k * prediction.columns + p] * slopes[p] / sigma;
      }
    }
  }
  return expected;
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

}  // namespace

SuggestedExperiment suggest_experiment(const Model& best, const std::vector<const Model*>& rivals) {
  constexpr double decisive = 30.0;  // log evidence expected: a shorter run is not worth less certainty
  SuggestedExperiment suggestion;
  double chosen_hours = 0.0;
  for (const auto& run : library()) {
    const recording::Recording inputs = inputs_of(run, best);
    const Expectation expected = expectation_of(best, inputs);
    double least = 1e300;
    const Model* nearest = nullptr;
    for (const Model* rival : rivals) {
      const Expectation other = expectation_of(*rival, inputs);
      if (other.values.size() != expected.values.size()) continue;
      const Eigen::VectorXd difference = expected.values - other.values;
      const double apart = std::min(evidence_against(expected, difference), evidence_against(other, difference));
      if (apart >= least) continue;
      least = apart;
      nearest = rival;
    }
    if (nearest == nullptr || least <= suggestion.distance) continue;
    if (suggestion.distance > decisive && hours_of(run) > chosen_hours) continue;
    chosen_hours = hours_of(run);
    suggestion.distance = least;
    suggestion.id = run.id;
    suggestion.plan_json = plan_of(run, best.network().full_speed_rpm).dump();
    // A best model without any effect: nothing is missing, or the rival is.
    const auto& effects = best.machine().effects;
    const bool named = !effects.empty() && effects.back().candidate;
    suggestion.text =
        explain_experiment(named ? effects.back().id : std::string(), nearest->machine().effects.back().id, run.text);
  }
  return suggestion;
}

}  // namespace zerodrift::diagnosis
