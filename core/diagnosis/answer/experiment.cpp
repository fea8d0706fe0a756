#include "core/diagnosis/answer/experiment.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/diagnosis/answer/explain.h"
#include "core/physics/builder.h"

namespace zerodrift::diagnosis::answer {
namespace {

using inference::Fit;

struct PlannedStep {
  double share;        // of the run's time
  double speed_share;  // of full speed
  bool coolant;
  double load_W;
};

/// One form of a run; how long it takes is chosen apart.
struct PlannedRun {
  const char* id;
  const char* text;
  std::vector<PlannedStep> steps;
};

const std::vector<PlannedRun>& library() {
  static const std::vector<PlannedRun> runs = {
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
const std::vector<PlannedRun>& library_of_heaters() {
  static const std::vector<PlannedRun> runs = {
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

/// The recording whose room and load a new run is planned with.
const recording::Recording& seen_by(const Fit& model) {
  return model.model().evidence().runs().front().recording;
}

bool turns(const Fit& model) {
  return seen_by(model).find("spindle_rpm") != nullptr;
}

/// The columns that heat a machine without a spindle, and the most of each.
std::map<std::string, double> heaters_of(const Fit& model) {
  std::map<std::string, double> most;
  for (const auto& component : model.model().hypothesis().machine.components) {
    for (const auto& source : component.sources) {
      const auto* seen = source.kind == physics::SourceKind::input ? seen_by(model).find(source.channel) : nullptr;
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
std::vector<int> ends_of(const PlannedRun& run, int minutes) {
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

recording::Recording inputs_of(const PlannedRun& run, int minutes, const Fit& model) {
  recording::Recording r;
  r.name = run.id;
  recording::Channel rpm{"spindle_rpm", {}}, coolant{"coolant_on", {}}, load{"spindle_load_W", {}};
  const double full_rpm = model.model().network(0).full_speed_rpm;
  const double idle_W_rpm = idle_load_W_rpm(seen_by(model));
  const std::vector<int> ends = ends_of(run, minutes);
  for (int minute = 0, step = 0; minute <= minutes; ++minute) {
    while (minute < minutes && minute >= ends[static_cast<std::size_t>(step)]) ++step;
    const PlannedStep& now = run.steps[static_cast<std::size_t>(step)];
    r.time_s.push_back(60.0 * minute);
    rpm.values.push_back(now.speed_share * full_rpm);
    coolant.values.push_back(now.coolant ? 1.0 : 0.0);
    load.values.push_back(now.load_W + idle_W_rpm * rpm.values.back());
  }
  const physics::Room& room = model.model().hypothesis().machine.room;
  double air_C = 20.0;
  if (!room.channel.empty()) {
    const recording::Recording& seen = seen_by(model);
    if (const auto* column = seen.find(room.channel)) air_C = recording::value_at(seen, *column, seen.time_s.front());
    r.channels.push_back({room.channel, std::vector<double>(r.rows(), air_C)});
  }
  // The run begins cold: every sensor at the room's temperature.
  for (const inference::MeasuredSeries& series : model.model().evidence().runs().front().series) {
    if (series.temperature && series.samples > 0)
      r.channels.push_back({series.channel, std::vector<double>(r.rows(), air_C)});
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

nlohmann::json plan_of(const PlannedRun& run, int minutes, double full_rpm) {
  nlohmann::json plan = {{"name", run.id}, {"sample_period_s", 10}, {"measure_period_s", 60}};
  const std::vector<int> ends = ends_of(run, minutes);
  for (std::size_t i = 0; i < run.steps.size(); ++i) {
    const PlannedStep& step = run.steps[i];
    plan["steps"].push_back({{"duration_s", 60 * (ends[i] - (i == 0 ? 0 : ends[i - 1]))},
                             {"spindle_rpm", std::round(step.speed_share * full_rpm)},
                             {"coolant_on", step.coolant},
                             {"path", "still"}});
    if (step.load_W > 0.0) plan["steps"].back()["spindle_load_W"] = step.load_W;
  }
  return plan;
}

/// What a model expects of a run, in standard deviations of noise at samples that are independent of each other
/// (neighbours share the slow drift: one in 15 minutes), and how its unknowns could bend that.
struct Expectation {
  Eigen::VectorXd values;
  Eigen::MatrixXd columns;    // by standardised unknowns
  Eigen::MatrixXd precision;  // of the unknowns after the first recording; what is new in each recording at its prior
};

/// A run that goes farther than the recording also shows more of what the description does not know.
std::vector<double> noise_of(const Fit& model, const physics::Prediction& prediction) {
  const inference::Evidence& evidence = model.model().evidence();
  const DiagnosisSettings& settings = evidence.settings();
  std::vector<double> sigmas;
  for (std::size_t c = 0; c < prediction.channels.size() && c < evidence.series(); ++c) {
    const inference::MeasuredSeries& series = evidence.runs().front().series[c];
    const auto& values = prediction.channels[c].values;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    const double slow =
        std::hypot(series.temperature ? settings.slow_K : settings.slow_um, settings.slow_share * (*high - *low));
    sigmas.push_back(std::hypot(std::max(series.slow, slow), series.white / 4.0));
  }
  return sigmas;
}

/// Index of the unknown that a parameter of another network of this hypothesis is; -1: none.
int unknown_of(const inference::JointModel& model, const physics::Parameter& parameter) {
  const int effect = model.hypothesis().effect_of(-1, parameter.effect);
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const inference::Unknown& unknown = model.unknown(i);
    const physics::Parameter& known = unknown.parameter;
    if (unknown.run <= 0 && unknown.effect == effect && known.key == parameter.key &&
        known.component == parameter.component && known.channel == parameter.channel &&
        (effect >= 0 || known.effect == parameter.effect))
      return static_cast<int>(i);
  }
  return -1;
}

/// In `sigmas` of noise, which the first model of a run sets.
Expectation expectation_of(const Fit& fit, const recording::Recording& inputs, std::vector<double>& sigmas) {
  const inference::JointModel& model = fit.model();
  // What happened once does not happen again.
  const physics::Network network = physics::build_network(model.hypothesis().machine_in(-1), inputs);
  std::vector<double> values = network.start_values();
  std::vector<int> parameters;
  std::vector<double> slopes;
  std::vector<Eigen::Index> rows;
  Eigen::MatrixXd precision = fit.quadratic().curvature;
  for (std::size_t at = 0; at < network.parameters.size(); ++at) {
    const int i = network.parameters[at].sigma > 0.0 ? unknown_of(model, network.parameters[at]) : -1;
    if (i < 0 || std::find(rows.begin(), rows.end(), i) != rows.end()) continue;
    const inference::Unknown& unknown = model.unknown(static_cast<std::size_t>(i));
    if (unknown.run < 0) values[at] = fit.value(static_cast<std::size_t>(i));
    parameters.push_back(static_cast<int>(at));
    slopes.push_back(network.parameters[at].slope_at(values[at]));
    rows.push_back(i);
    if (unknown.run < 0) continue;
    precision.row(i).setZero();
    precision.col(i).setZero();
    precision(i, i) = 1.0;
  }
  Expectation expected;
  const auto n = static_cast<Eigen::Index>(rows.size());
  expected.precision.resize(n, n);
  for (Eigen::Index a = 0; a < n; ++a) {
    for (Eigen::Index b = 0; b < n; ++b)
      expected.precision(a, b) = precision(rows[static_cast<std::size_t>(a)], rows[static_cast<std::size_t>(b)]);
  }
  const physics::Prediction prediction =
      physics::predict(network, physics::make_inputs(network, inputs), values, parameters);
  if (sigmas.empty()) sigmas = noise_of(fit, prediction);
  constexpr std::size_t stride = 15;
  const std::size_t per_channel = (prediction.rows - 1) / stride;  // the start tells nothing
  expected.values.setZero(static_cast<Eigen::Index>(per_channel * prediction.channels.size()));
  expected.columns.setZero(expected.values.size(), n);
  for (std::size_t c = 0; c < sigmas.size(); ++c) {
    if (model.evidence().samples(c) == 0) continue;
    for (std::size_t k = stride; k < prediction.rows; k += stride) {
      const auto row = static_cast<Eigen::Index>(c * per_channel + k / stride - 1);
      expected.values[row] = prediction.channels[c].values[k] / sigmas[c];
      for (std::size_t p = 0; p < parameters.size(); ++p) {
        expected.columns(row, static_cast<Eigen::Index>(p)) =
            prediction.channels[c].derivatives[k * prediction.columns + p] * slopes[p] / sigmas[c];
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
  const Fit* first = nullptr;
  const Fit* second = nullptr;
};

constexpr double decisive = 30.0;  // log evidence expected

Contest contest_in(const PlannedRun& run, int minutes, const std::vector<const Fit*>& models) {
  const recording::Recording inputs = inputs_of(run, minutes, *models.front());
  std::vector<double> sigmas;
  std::vector<Expectation> expected;
  for (const Fit* model : models) expected.push_back(expectation_of(*model, inputs, sigmas));
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

/// The effect that one has and the other has not; none where there is no such.
std::string beyond(const Fit& one, const Fit& other) {
  for (const inference::HeldEffect& held : one.model().hypothesis().effects) {
    const auto& effects = other.model().hypothesis().effects;
    if (std::none_of(effects.begin(), effects.end(), [&](const auto& known) {
          return known.spec.id == held.spec.id && known.spec.words == held.spec.words;
        }))
      return held.spec.id;
  }
  return {};
}

}  // namespace

SuggestedExperiment suggest_experiment(const Fit& best, const std::vector<const Fit*>& rivals) {
  std::vector<const Fit*> models = {&best};
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
      if (spindle) suggestion.plan_json = json_text(plan_of(run, minutes, best.model().network(0).full_speed_rpm));
      std::string first = beyond(*contest.first, *contest.second), second = beyond(*contest.second, *contest.first);
      if (second.empty()) std::swap(first, second);
      suggestion.text = explain_experiment(first, second, run.text, minutes);
    }
    if (suggestion.distance > decisive) break;
  }
  return suggestion;
}

}  // namespace zerodrift::diagnosis::answer
