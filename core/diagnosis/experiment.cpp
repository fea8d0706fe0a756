#include "core/diagnosis/experiment.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/diagnosis/explain.h"

namespace zerodrift::diagnosis {
namespace {

struct Step {
  double share;        // of the run's time
  double speed_share;  // of full speed
  bool coolant;
  double load_W;
};

/// One form of a run; how long it takes is chosen apart.
struct Run {
  const char* id;
  const char* text;
  std::vector<Step> steps;
};

const std::vector<Run>& library() {
  static const std::vector<Run> runs = {
      {"full_then_stop",
       "full speed without coolant for half of the time, then stop and record the cooling",
       {{0.5, 1.0, false, 0}, {0.5, 0.0, false, 0}}},
      {"coolant_once",
       "two thirds of full speed, 40 % of the time without coolant, 35 % with it, then stop and record the cooling",
       {{0.4, 0.67, false, 0}, {0.35, 0.67, true, 0}, {0.25, 0.0, false, 0}}},
      {"half_speed", "half speed without coolant", {{1.0, 0.5, false, 0}}},
      {"staircase",
       "25, 50, 75 and 100 % of full speed, a quarter of the time each",
       {{0.25, 0.25, false, 0}, {0.25, 0.5, false, 0}, {0.25, 0.75, false, 0}, {0.25, 1.0, false, 0}}},
      {"start_stop",
       "full speed and stop in turn, four equal parts",
       {{0.25, 1.0, false, 0}, {0.25, 0.0, false, 0}, {0.25, 1.0, false, 0}, {0.25, 0.0, false, 0}}},
      {"coolant_toggle",
       "full speed, coolant off and on in turn, four equal parts",
       {{0.25, 1.0, false, 0}, {0.25, 1.0, true, 0}, {0.25, 1.0, false, 0}, {0.25, 1.0, true, 0}}},
      {"hot_and_cold",
       "half speed cold, full speed for half of the time, half speed hot, then stop",
       {{0.125, 0.5, false, 0}, {0.5, 1.0, false, 0}, {0.125, 0.5, false, 0}, {0.25, 0.0, false, 0}}},
      {"cutting_toggle",
       "half speed, no cutting and cutting in turn, four equal parts",
       {{0.25, 0.5, false, 0}, {0.25, 0.5, false, 2000}, {0.25, 0.5, false, 0}, {0.25, 0.5, false, 2000}}}};
  return runs;
}

/// Where no spindle turns: shares of the most that was given of what heats.
const std::vector<Run>& library_of_heaters() {
  static const std::vector<Run> runs = {
      {"heat_then_stop",
       "full power for half of the time, then off, and record the cooling",
       {{0.5, 1.0, false, 0}, {0.5, 0.0, false, 0}}},
      {"heat_on_off",
       "full power and off in turn, four equal parts",
       {{0.25, 1.0, false, 0}, {0.25, 0.0, false, 0}, {0.25, 1.0, false, 0}, {0.25, 0.0, false, 0}}},
      {"heat_staircase",
       "25, 50, 75 and 100 % of full power, a quarter of the time each",
       {{0.25, 0.25, false, 0}, {0.25, 0.5, false, 0}, {0.25, 0.75, false, 0}, {0.25, 1.0, false, 0}}}};
  return runs;
}

bool turns(const Model& model) {
  return model.data().recording->find("spindle_rpm") != nullptr;
}

/// The columns that heat a machine without a spindle, and the most of each.
std::map<std::string, double> heaters_of(const Model& model) {
  std::map<std::string, double> most;
  for (const auto& component : model.machine().components) {
    for (const auto& source : component.sources) {
      const auto* seen =
          source.kind == physics::SourceKind::input ? model.data().recording->find(source.channel) : nullptr;
      if (seen == nullptr) continue;
      for (const double value : seen->values) {
        if (std::isfinite(value)) most[source.channel] = std::max(most[source.channel], value);
      }
    }
  }
  return most;
}

constexpr std::array lengths_min{30, 45, 60, 90, 120, 180, 210};

/// When each step of a run of this length ends, in whole minutes.
std::vector<int> ends_of(const Run& run, int minutes) {
  std::vector<int> ends;
  double share = 0.0;
  for (const auto& step : run.steps) {
    share += step.share;
    ends.push_back(static_cast<int>(std::lround(share * minutes)));
  }
  return ends;
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

recording::Recording inputs_of(const Run& run, int minutes, const Model& model) {
  recording::Recording r;
  r.name = run.id;
  recording::Channel rpm{"spindle_rpm", {}}, coolant{"coolant_on", {}}, load{"spindle_load_W", {}};
  const double full_rpm = model.network().full_speed_rpm;
  const double idle_W_rpm = idle_load_W_rpm(*model.data().recording);
  const std::vector<int> ends = ends_of(run, minutes);
  for (int minute = 0, step = 0; minute <= minutes; ++minute) {
    while (minute < minutes && minute >= ends[static_cast<std::size_t>(step)]) ++step;
    const Step& now = run.steps[static_cast<std::size_t>(step)];
    r.time_s.push_back(60.0 * minute);
    rpm.values.push_back(now.speed_share * full_rpm);
    coolant.values.push_back(now.coolant ? 1.0 : 0.0);
    load.values.push_back(now.load_W + idle_W_rpm * rpm.values.back());
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
  if (!turns(model)) {
    for (const auto& [column, most] : heaters_of(model)) {
      recording::Channel& heats = r.ensure(column);
      heats.values.clear();
      for (const double share_rpm : rpm.values) heats.values.push_back(most * share_rpm / full_rpm);
    }
  }
  return r;
}

nlohmann::json plan_of(const Run& run, int minutes, double full_rpm) {
  nlohmann::json plan = {{"name", run.id}, {"sample_period_s", 10}, {"measure_period_s", 60}};
  const std::vector<int> ends = ends_of(run, minutes);
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const Step& step = run.steps[i];
    plan["steps"].push_back({{"duration_s", 60 * (ends[i] - (i == 0 ? 0 : ends[i - 1]))},
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

/// A run that goes farther than the recording also shows more of what the description does not know.
std::vector<double> noise_widths(const Model& model, const physics::Prediction& prediction) {
  std::vector<double> widths;
  for (std::size_t c = 0; c < prediction.channels.size() && c < model.data().channels.size(); ++c) {
    const MeasuredChannel& channel = model.data().channels[c];
    const auto& values = prediction.channels[c].values;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double drift = std::max(channel.drift, ordinary_drift(channel.temperature, *high - *low));
    widths.push_back(std::hypot(drift, channel.white / 4.0));
  }
  return widths;
}

/// In `widths` of noise, which the first model of a run sets.
Expectation expectation_of(const Model& model, const recording::Recording& inputs, std::vector<double>& widths) {
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
  if (widths.empty()) widths = noise_widths(model, prediction);
  constexpr std::size_t stride = 15;
  const std::size_t per_channel = (prediction.rows - 1) / stride;  // the start tells nothing
  expected.values.setZero(static_cast<Eigen::Index>(per_channel * prediction.channels.size()));
  expected.columns.setZero(expected.values.size(), static_cast<Eigen::Index>(parameters.size()));
  for (std::size_t c = 0; c < widths.size(); ++c) {
    if (model.data().channels[c].samples == 0) continue;
    const double sigma = widths[c];
    for (std::size_t k = stride; k < prediction.rows; k += stride) {
      const auto row = static_cast<Eigen::Index>(c * per_channel + k / stride - 1);
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

/// How well a run would tell all pairs of these models apart.
struct Contest {
  double told = 0.0;     // sum over the pairs of the expected log evidence, of each as much as decides
  double least = 1e300;  // of the pair that is told apart least
  const Model* first = nullptr;
  const Model* second = nullptr;
};

constexpr double decisive = 30.0;  // log evidence expected

Contest contest_in(const Run& run, int minutes, const std::vector<const Model*>& models) {
  const recording::Recording inputs = inputs_of(run, minutes, *models.front());
  std::vector<double> widths;
  std::vector<Expectation> expected;
  for (const Model* model : models) expected.push_back(expectation_of(*model, inputs, widths));
  Contest contest;
  for (std::size_t i = 0; i < models.size(); ++i) {
    for (std::size_t j = i + 1; j < models.size(); ++j) {
      if (expected[i].values.size() != expected[j].values.size()) continue;
      const Eigen::VectorXd difference = expected[i].values - expected[j].values;
      const double apart =
          std::min(evidence_against(expected[i], difference), evidence_against(expected[j], difference));
      contest.told += std::min(apart, decisive);
      if (apart >= contest.least) continue;
      contest.least = apart;
      contest.first = models[i];
      contest.second = models[j];
    }
  }
  return contest;
}

/// The effect in question; none where the model is the description as it is.
std::string questioned(const Model& model) {
  const auto& effects = model.machine().effects;
  return !effects.empty() && effects.back().candidate ? effects.back().id : std::string();
}

}  // namespace

SuggestedExperiment suggest_experiment(const Model& best, const std::vector<const Model*>& rivals) {
  std::vector<const Model*> models = {&best};
  models.insert(models.end(), rivals.begin(), rivals.end());
  SuggestedExperiment suggestion;
  double told = 0.0;
  const bool spindle = turns(best);
  if (!spindle && heaters_of(best).empty()) return suggestion;
  for (const int minutes : lengths_min) {
    for (const auto& run : spindle ? library() : library_of_heaters()) {
      const Contest contest = contest_in(run, minutes, models);
      // Where all is decided, the surer one.
      const double worth = contest.told + 1e-3 * std::min(contest.least, 1e3 * decisive);
      if (contest.first == nullptr || worth <= told) continue;
      told = worth;
      suggestion.distance = contest.least;
      suggestion.id = run.id;
      // A warm-up plan gives speeds; what heats a machine without a spindle its owner switches.
      if (spindle) suggestion.plan_json = json_text(plan_of(run, minutes, best.network().full_speed_rpm));
      suggestion.text = explain_experiment(questioned(*contest.first), questioned(*contest.second), run.text, minutes);
    }
    if (suggestion.distance > decisive) break;
  }
  return suggestion;
}

}  // namespace zerodrift::diagnosis
