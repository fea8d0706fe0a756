#include "core/diagnosis/experiment.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/diagnosis/explain.h"
#include "core/diagnosis/refined.h"

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

const std::vector<Run>& library() {
  static const std::vector<Run> runs = {
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

recording::Recording inputs_of(const Run& run, const Model& model) {
  recording::Recording r;
  r.name = run.id;
  recording::Channel rpm{"spindle_rpm", {}}, coolant{"coolant_on", {}}, load{"spindle_load_W", {}};
  const double full_rpm = model.network().full_speed_rpm;
  double start_s = 0.0;
  for (const auto& step : run.steps) {
    for (double t = start_s; t < start_s + 3600.0 * step.hours - 1.0; t += 60.0) {
      r.time_s.push_back(t);
      rpm.values.push_back(step.speed_share * full_rpm);
      coolant.values.push_back(step.coolant ? 1.0 : 0.0);
      load.values.push_back(step.load_W);
    }
    start_s = r.time_s.back() + 60.0;
  }
  const physics::Room& room = model.machine().room;
  if (!room.channel.empty()) {
    recording::Channel air{room.channel, std::vector<double>(r.rows(), 20.0)};
    if (const auto* seen = model.data().recording->find(room.channel)) {
      air.values.assign(r.rows(), recording::value_at(*model.data().recording, *seen, model.data().time_s.front()));
    }
    r.channels.push_back(air);
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
    plan["steps"].push_back({{"duration_s", std::round(3600.0 * step.hours)},
                             {"spindle_rpm", std::round(step.speed_share * full_rpm)},
                             {"coolant_on", step.coolant},
                             {"path", "still"}});
    if (step.load_W > 0.0) plan["steps"].back()["spindle_load_W"] = step.load_W;
  }
  return plan;
}

}  // namespace

SuggestedExperiment suggest_experiment(const Model& best, const Model& rival) {
  const physics::Machine one = refined_machine(best);
  const physics::Machine other = refined_machine(rival);
  SuggestedExperiment suggestion;
  for (const auto& run : library()) {
    const recording::Recording inputs = inputs_of(run, best);
    const auto predicted = [&](const physics::Machine& machine) {
      const physics::Network network = physics::build_network(machine, inputs);
      return physics::predict(network, physics::make_inputs(network, inputs), network.start_values());
    };
    const physics::Prediction a = predicted(one);
    const physics::Prediction b = predicted(other);
    double distance = 0.0;
    for (std::size_t c = 0; c < a.channels.size() && c < best.data().channels.size(); ++c) {
      const MeasuredChannel& channel = best.data().channels[c];
      if (channel.samples == 0) continue;
      // Neighbouring samples share the slow drift: one independent sample in 15 minutes.
      const double sigma = std::hypot(channel.drift, channel.white / 4.0);
      for (std::size_t k = 0; k < a.rows; k += 15) {
        const double d = (a.channels[c].values[k] - b.channels[c].values[k]) / sigma;
        distance += 0.5 * d * d;
      }
    }
    if (distance <= suggestion.distance) continue;
    suggestion.distance = distance;
    suggestion.id = run.id;
    suggestion.plan_json = plan_of(run, best.network().full_speed_rpm).dump();
    suggestion.text = explain_experiment(best.machine().effects.back().id, rival.machine().effects.back().id, run.text);
  }
  return suggestion;
}

}  // namespace zerodrift::diagnosis
