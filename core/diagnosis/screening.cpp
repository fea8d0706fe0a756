#include "core/diagnosis/screening.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

#include "core/diagnosis/parallel.h"

namespace zerodrift::diagnosis {
namespace {

using Eigen::Index;
using physics::EffectSpec;
using physics::Machine;

bool varies(const recording::Recording& recording, const char* name) {
  const recording::Channel* channel = recording.find(name);
  return channel != nullptr &&
         std::any_of(channel->values.begin(), channel->values.end(), [](double v) { return std::abs(v) > 1e-9; });
}

std::pair<double, double> limits(const recording::Channel& channel) {
  double low = 1e300, high = -1e300;
  for (const double v : channel.values) {
    if (!std::isfinite(v)) continue;
    low = std::min(low, v);
    high = std::max(high, v);
  }
  return {low, high};
}

/// The moments of the largest single-sample jumps, each at the first sample after it.
std::vector<double> jumps(const recording::Channel& channel, const std::vector<double>& time_s) {
  std::vector<std::pair<double, double>> list;
  const double noise = physics::noise_width(channel.values, 0.05);
  constexpr std::size_t at_the_ends = 5;  // samples: a step there is no more than a disturbed start or end
  const auto& v = channel.values;
  const auto slope = [&](std::size_t from, std::size_t to) { return (v[to] - v[from]) / (time_s[to] - time_s[from]); };
  const auto middle = [](double a, double b) { return 0.5 * (a + b); };
  for (std::size_t k = at_the_ends; k + at_the_ends < time_s.size(); ++k) {
    // Beside what the slope before and after lets expect: a spindle that warms up grows by micrometres a minute.
    const double apart_s = middle(time_s[k], time_s[k + 1]) - middle(time_s[k - 1], time_s[k - 2]);
    const double grown = apart_s * middle(slope(k - 4, k - 1), slope(k, k + 3));
    const double jump = std::abs(middle(v[k], v[k + 1]) - middle(v[k - 1], v[k - 2]) - grown);
    if (std::isfinite(jump) && jump > 4.0 * noise) list.emplace_back(jump, time_s[k]);
  }
  std::sort(list.rbegin(), list.rend());
  std::vector<double> times_s;
  for (const auto& [jump, at_s] : list) {
    const bool near =
        std::any_of(times_s.begin(), times_s.end(), [&, t = at_s](double s) { return std::abs(s - t) < 300.0; });
    if (!near) times_s.push_back(at_s);
    if (times_s.size() == 3) break;
  }
  return times_s;
}

// Shares of the length within which no second of the kind is looked for.
constexpr double source_alone = 0.07;
constexpr double joint_alone = 0.25;

bool conflicts(const Machine& machine, const EffectSpec& have, const EffectSpec& want) {
  if (have.id != want.id) return false;
  const auto same = [&](const char* word) { return have.word_or(word, "") == want.word_or(word, ""); };
  if (have.id == "extra_heat_source" || have.id == "contact_resistance") {
    const physics::Component* component = machine.find(want.word_or("component", ""));
    const double length_mm = component == nullptr ? 1.0 : component->length_mm;
    // One joint of a body that has an inside is a little wider than a plane: a second beside it would only mend that.
    const double near_mm = (have.id == "contact_resistance" ? joint_alone : source_alone) * length_mm;
    return same("law") && std::abs(have.number_or("position_mm", 0) - want.number_or("position_mm", 0)) < near_mm;
  }
  if (have.id == "neighbour_heat") return same("component") && same("neighbour");
  if (have.words.count("channel") != 0 || want.words.count("channel") != 0) return same("channel");
  if (have.words.count("component") != 0 && want.words.count("component") != 0) return same("component");
  return true;
}

/// What cannot be there without a plain film is not offered before one is in the model.
bool premature(const Machine& machine, const EffectSpec& spec) {
  static constexpr std::string_view refinements[] = {"radiation", "speed_convection", "draught", "casting_core"};
  if (std::find(std::begin(refinements), std::end(refinements), spec.id) == std::end(refinements)) return false;
  const std::string component = spec.word_or("component", "");
  return std::none_of(machine.effects.begin(), machine.effects.end(), [&](const EffectSpec& have) {
    const std::string other = have.word_or("component", "");
    return have.id == "convection" && (component.empty() || other.empty() || component == other);
  });
}

/// A lump whose sensor is a fluid that somebody else controls (a chiller) is no part of the machine: nothing that the
/// machine lacks explains its temperature.
bool of_a_fluid(const Machine& machine, const EffectSpec& spec) {
  const std::string component = spec.word_or("component", "");
  if (component.empty()) return false;
  return std::any_of(machine.sensors.begin(), machine.sensors.end(), [&](const auto& sensor) {
    return sensor.component == component &&
           std::any_of(machine.fluids.begin(), machine.fluids.end(),
                       [&](const auto& fluid) { return fluid.temperature_channel == sensor.channel; });
  });
}

/// A form that replaces part of the network cannot stand beside its rivals in one simulation.
bool stands_alone(const EffectSpec& spec) {
  return spec.id == "heater_body";
}

struct Columns {
  std::vector<int> parameters;
  std::vector<double> slopes;
  std::vector<std::pair<std::size_t, std::size_t>> of_candidate;  // first column, count
};

Columns amplitude_columns(const physics::Network& network, std::size_t first_effect, std::size_t count) {
  Columns columns;
  columns.of_candidate.assign(count, {0, 0});
  for (std::size_t c = 0; c < count; ++c) {
    columns.of_candidate[c].first = columns.parameters.size();
    for (std::size_t p = 0; p < network.parameters.size(); ++p) {
      const auto& parameter = network.parameters[p];
      if (parameter.effect != static_cast<int>(first_effect + c) || !parameter.amplitude) continue;
      columns.parameters.push_back(static_cast<int>(p));
      columns.slopes.push_back(parameter.sigma);
    }
    columns.of_candidate[c].second = columns.parameters.size() - columns.of_candidate[c].first;
  }
  return columns;
}

/// How a reading changes with its sensor's lag, as the chord to a usual lag (in a short run to one that it could show):
/// the tangent at none says little, it stands for the moments of switching alone, where the timing is uncertain.
void take_chords_of_lags(const physics::Network& network, const std::vector<Candidate>& group, const Columns& columns,
                         const std::vector<double>& time_s, physics::Prediction& prediction) {
  constexpr double share_of_run = 0.02;
  for (std::size_t c = 0; c < group.size(); ++c) {
    if (group[c].spec.id != "sensor_lag" || columns.of_candidate[c].second == 0) continue;
    const std::size_t column = columns.of_candidate[c].first;
    const double spread_s = network.parameters[static_cast<std::size_t>(columns.parameters[column])].sigma;
    const double usual_s = std::min(spread_s, share_of_run * (time_s.back() - time_s.front()));
    for (physics::PredictedChannel& channel : prediction.channels) {
      if (channel.channel != group[c].spec.word_or("channel", "")) continue;
      const std::vector<double> late = physics::lagged(channel.values, time_s, usual_s);
      for (std::size_t k = 0; k < late.size(); ++k) {
        channel.derivatives[k * prediction.columns + column] = (late[k] - channel.values[k]) / usual_s;
      }
    }
  }
}

/// The efficient score of every candidate's amplitudes, with the base's own unknowns fitted beside them.
struct Scores {
  const physics::Network& network;
  const Columns& columns;
  const Eigen::VectorXd& gradient;
  const Eigen::MatrixXd& information;

  struct Step {
    double gain = 0.0;
    Eigen::VectorXd step;
  };
  bool forbidden(std::size_t candidate, double amplitude) const {
    const std::size_t main = columns.of_candidate[candidate].first;
    return network.parameters[static_cast<std::size_t>(columns.parameters[main])].low >= 0.0 && amplitude <= 0.0;
  }
  /// Of two together; none where physics forbids a sign.
  Step together(std::size_t a, std::size_t b) const {
    std::vector<Index> at;
    for (const std::size_t candidate : {a, b}) {
      const auto [first, count] = columns.of_candidate[candidate];
      for (std::size_t i = 0; i < count; ++i) at.push_back(static_cast<Index>(first + i));
    }
    const Eigen::VectorXd g = gradient(at);
    Step both;
    both.step = information(at, at).ldlt().solve(g);
    const auto second = static_cast<Index>(columns.of_candidate[a].second);
    if (!forbidden(a, both.step[0]) && !forbidden(b, both.step[second])) both.gain = both.step.dot(g);
    return both;
  }
};

/// Looks through all pairs of different effects: the derivatives are there, a pair costs a few numbers.
void find_pair(const Scores& scores, const std::vector<Candidate>& group, double least, HiddenPair& pair) {
  for (std::size_t a = 0; a < group.size(); ++a) {
    for (std::size_t b = a + 1; b < group.size(); ++b) {
      const std::size_t of_a = scores.columns.of_candidate[a].second;
      if (group[a].spec.id == group[b].spec.id || of_a == 0 || scores.columns.of_candidate[b].second == 0) continue;
      const Scores::Step both = scores.together(a, b);
      if (both.gain <= pair.gain || both.gain <= group[a].gain + group[b].gain + least) continue;
      pair.gain = both.gain;
      pair.effects = {group[a], group[b]};
      const double* step = both.step.data();
      pair.effects[0].step.assign(step, step + of_a);
      pair.effects[1].step.assign(step + of_a, step + both.step.size());
    }
  }
}

/// Of long matrices, the one thing beside the simulation that takes time: column by column side by side.
void over_columns(Index columns, const std::function<void(Index first, Index count)>& job) {
  constexpr Index width = 32;
  in_parallel(static_cast<std::size_t>((columns + width - 1) / width), [&](std::size_t i) {
    const Index first = static_cast<Index>(i) * width;
    job(first, std::min(width, columns - first));
  });
}

/// a' b
Eigen::MatrixXd products(const RowMatrix& a, const RowMatrix& b) {
  Eigen::MatrixXd result(a.cols(), b.cols());
  over_columns(b.cols(), [&](Index first, Index count) {
    result.middleCols(first, count).noalias() = a.transpose() * b.middleCols(first, count);
  });
  return result;
}

/// a' a
Eigen::MatrixXd products(const RowMatrix& a) {
  Eigen::MatrixXd upper = Eigen::MatrixXd::Zero(a.cols(), a.cols());
  over_columns(a.cols(), [&](Index first, Index count) {
    const Index rows = first + count;
    upper.block(0, first, rows, count).noalias() = a.leftCols(rows).transpose() * a.middleCols(first, count);
  });
  return upper.selfadjointView<Eigen::Upper>();
}

/// Scores a group of candidates that may stand side by side.
void score(const Model& base, const Eigen::LLT<Eigen::MatrixXd>& factors, std::vector<Candidate>& group,
           HiddenPair* pair = nullptr, double least = 0.0) {
  if (group.empty()) return;
  Machine machine = base.machine();
  const std::size_t first_effect = machine.effects.size();
  for (const auto& candidate : group) machine.effects.push_back(candidate.spec);
  Model wide(std::move(machine), base.shared_data());
  wide.start_from(base, false);
  const Columns columns = amplitude_columns(wide.network(), first_effect, group.size());
  physics::Prediction prediction = predicted(wide.network(), wide.inputs(), wide.values(), columns.parameters);
  take_chords_of_lags(wide.network(), group, columns, wide.inputs().time_s, prediction);
  RowMatrix s(base.residual().size(), static_cast<Index>(columns.parameters.size()));
  std::vector<int> targets(columns.parameters.size());
  for (std::size_t i = 0; i < targets.size(); ++i) targets[i] = static_cast<int>(i);
  whiten_columns(base.data(), prediction, columns.slopes, s, targets);
  const Eigen::MatrixXd js = products(base.jacobian(), s);
  const Eigen::MatrixXd solved = factors.solve(js);
  const Eigen::VectorXd base_gradient = base.jacobian().transpose() * base.residual() - base.z();
  const Eigen::VectorXd gradient = s.transpose() * base.residual() - solved.transpose() * base_gradient;
  for (std::size_t c = 0; c < group.size(); ++c) {
    const Index first = static_cast<Index>(columns.of_candidate[c].first);
    const Index count = static_cast<Index>(columns.of_candidate[c].second);
    if (count == 0) continue;
    const auto block = s.middleCols(first, count);
    Eigen::MatrixXd d = block.transpose() * block + Eigen::MatrixXd::Identity(count, count) -
                        js.middleCols(first, count).transpose() * solved.middleCols(first, count);
    const Eigen::VectorXd g = gradient.segment(first, count);
    Eigen::VectorXd step = d.ldlt().solve(g);
    double gain = step.dot(g);
    const auto& main = wide.network().parameters[columns.parameters[static_cast<std::size_t>(first)]];
    group[c].detectable = 5.0 * main.sigma / std::sqrt(std::max(1e-12, d(0, 0)));
    group[c].usual = main.sigma;
    if (main.low >= 0.0 && step[0] <= 0.0) gain = 0.0;  // physics forbids the sign
    group[c].gain = gain;
    group[c].step.assign(step.data(), step.data() + count);
  }
  if (pair == nullptr) return;
  const Eigen::MatrixXd information =
      products(s) + Eigen::MatrixXd::Identity(s.cols(), s.cols()) - js.transpose() * solved;
  find_pair({wide.network(), columns, gradient, information}, group, least, *pair);
}

}  // namespace

physics::RunFacts facts_of(const Machine& machine, const recording::Recording& recording) {
  physics::RunFacts facts;
  facts.duration_s = recording.time_s.back() - recording.time_s.front();
  facts.has_speed = varies(recording, "spindle_rpm");
  facts.has_coolant = varies(recording, "coolant_on");
  facts.has_load = varies(recording, "spindle_load_W");
  facts.room_logged = !machine.room.channel.empty() && recording.find(machine.room.channel) != nullptr;
  facts.full_speed_rpm = machine.rated_speed_rpm();
  if (const auto* speed = recording.find("spindle_rpm"); speed != nullptr && facts.full_speed_rpm <= 0.0) {
    facts.full_speed_rpm = std::max(1.0, limits(*speed).second);
  }
  for (const auto& component : machine.components) {
    for (const auto& source : component.sources) {
      double input = facts.full_speed_rpm;
      const bool by_speed = source.kind == physics::SourceKind::motor || source.kind == physics::SourceKind::bearing;
      if (const auto* channel = recording.find(source.channel); !by_speed && channel != nullptr) {
        input = limits(*channel).second;
      }
      facts.typical_heat_W += physics::nominal_heat_W(source, input, std::max(1.0, facts.full_speed_rpm));
    }
  }
  for (const auto& sensor : machine.sensors) {
    const auto* channel = recording.find(sensor.channel);
    if (channel == nullptr || recording::present_count(*channel) < 10) continue;
    facts.channels.push_back(sensor.channel);
    const auto [low, high] = limits(*channel);
    facts.temperature_rise_K = std::max(facts.temperature_rise_K, high - low);
  }
  for (const auto& displacement : machine.displacements) {
    const auto* channel = recording.find(displacement.channel);
    if (channel == nullptr || recording::present_count(*channel) < 10) continue;
    const auto [low, high] = limits(*channel);
    facts.displacement_range_um = std::max(facts.displacement_range_um, high - low);
    facts.jump_times_s[displacement.channel] = jumps(*channel, recording.time_s);
  }
  return facts;
}

std::vector<Candidate> screen(const Model& base, const physics::RunFacts& facts, HiddenPair* pair, double least) {
  // What is simulated side by side: in two halves, each on a processor, unless pairs of all are looked through.
  std::vector<std::vector<Candidate>> groups(pair == nullptr ? 2 : 1);
  const std::size_t halves = groups.size();
  std::size_t count = 0;
  const auto measured = [&](const EffectSpec& spec) {
    const std::string channel = spec.word_or("channel", "");
    if (channel.empty()) return true;
    for (const auto& one : base.data().channels) {
      if (one.name == channel) return one.samples > 0;
    }
    return false;
  };
  for (const physics::Effect* effect : physics::all_effects()) {
    auto forms = effect->candidates(base.machine(), facts);
    for (auto& spec : forms) {
      // What may stand in many forms finds one that fits by chance: its prior is spread over them.
      spec.log_prior = -std::log(static_cast<double>(forms.size()));
      const bool taken = std::any_of(base.machine().effects.begin(), base.machine().effects.end(),
                                     [&](const EffectSpec& have) { return conflicts(base.machine(), have, spec); });
      if (taken || !measured(spec) || premature(base.machine(), spec) || of_a_fluid(base.machine(), spec)) continue;
      Candidate candidate{std::move(spec), 0, 0, {}};
      if (stands_alone(candidate.spec)) {
        groups.push_back({std::move(candidate)});
      } else {
        groups[count++ % halves].push_back(std::move(candidate));
      }
    }
  }
  const Eigen::LLT<Eigen::MatrixXd> factors(base.hessian());
  in_parallel(groups.size(), [&](std::size_t i) { score(base, factors, groups[i], i == 0 ? pair : nullptr, least); });
  std::vector<Candidate> all;
  for (auto& group : groups) std::move(group.begin(), group.end(), std::back_inserter(all));
  std::stable_sort(all.begin(), all.end(), [](auto& a, auto& b) { return a.gain > b.gain; });
  return all;
}

bool doubles_a_joint(const Model& model) {
  const Machine& machine = model.machine();
  std::vector<std::pair<std::string, double>> joints;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const auto& unknown = model.unknown(i);
    if (unknown.effect < 0 || unknown.key != "position_mm") continue;
    const EffectSpec& spec = machine.effects[static_cast<std::size_t>(unknown.effect)];
    if (spec.id == "contact_resistance") joints.emplace_back(spec.word_or("component", ""), model.value(i));
  }
  for (std::size_t a = 0; a < joints.size(); ++a) {
    for (std::size_t b = a + 1; b < joints.size(); ++b) {
      const physics::Component* component = machine.find(joints[a].first);
      if (component == nullptr || joints[a].first != joints[b].first) continue;
      if (std::abs(joints[a].second - joints[b].second) < joint_alone * component->length_mm) return true;
    }
  }
  return false;
}

bool mends_a_joint(const Model& model) {
  const Machine& machine = model.machine();
  const std::vector<EffectSpec>& effects = machine.effects;
  if (effects.empty()) return false;
  const EffectSpec& last = effects.back();
  const auto number = [&](std::size_t effect, std::string_view key) {
    for (std::size_t i = 0; i < model.unknowns(); ++i) {
      const auto& unknown = model.unknown(i);
      if (unknown.effect == static_cast<int>(effect) && unknown.key == key) return model.value(i);
    }
    return effects[effect].number_or(std::string(key), std::nan(""));
  };
  const physics::Sensor* sensor =
      last.id.starts_with("sensor_") ? machine.sensor(last.word_or("channel", "")) : nullptr;
  if (last.id != "extra_heat_source" && sensor == nullptr) return false;
  // A joint's edge is not as sharp as the one that is fitted: a sensor beside it reads some share of the step.
  constexpr double edge = 2.0;
  const double at_mm = sensor != nullptr ? sensor->position_mm : number(effects.size() - 1, "position_mm");
  const std::string component = sensor != nullptr ? sensor->component : last.word_or("component", "");
  const double breadths = sensor != nullptr ? edge : 1.0;
  for (std::size_t i = 0; i + 1 < effects.size(); ++i) {
    if (effects[i].id != "contact_resistance" || effects[i].word_or("component", "") != component) continue;
    if (std::abs(number(i, "position_mm") - at_mm) < breadths * number(i, "half_width_mm")) return true;
  }
  return false;
}

std::shared_ptr<Model> extended(const Model& base, const Candidate& candidate) {
  return extended(base, std::span(&candidate, 1));
}

std::shared_ptr<Model> extended(const Model& base, std::span<const Candidate> candidates) {
  Machine machine = base.machine();
  const int before = static_cast<int>(machine.effects.size());
  for (const Candidate& candidate : candidates) machine.effects.push_back(candidate.spec);
  auto model = std::make_shared<Model>(std::move(machine), base.shared_data());
  model->start_from(base, true);
  model->gain = candidates.back().gain;
  std::vector<std::size_t> amplitudes(candidates.size(), 0);
  for (std::size_t i = 0; i < model->unknowns(); ++i) {
    const auto& parameter = model->unknown(i);
    if (parameter.effect < before || !parameter.amplitude) continue;
    const auto of = static_cast<std::size_t>(parameter.effect - before);
    const std::vector<double>& step = candidates[of].step;
    if (amplitudes[of] < step.size()) model->set_z(i, std::clamp(step[amplitudes[of]++], -3.0, 3.0));
  }
  return model;
}

std::shared_ptr<Model> reduced(const Model& model, std::size_t index) {
  Machine reordered = model.machine();
  reordered.effects.erase(reordered.effects.begin() + static_cast<std::ptrdiff_t>(index));
  auto result = std::make_shared<Model>(std::move(reordered), model.shared_data());
  for (std::size_t i = 0; i < result->unknowns(); ++i) {
    const auto& want = result->unknown(i);
    const int source = want.effect >= static_cast<int>(index) ? want.effect + 1 : want.effect;
    for (std::size_t k = 0; k < model.unknowns(); ++k) {
      const auto& have = model.unknown(k);
      if (have.key == want.key && have.component == want.component && have.channel == want.channel &&
          have.effect == source) {
        result->set_z(i, model.z()[static_cast<Index>(k)]);
        break;
      }
    }
  }
  return result;
}

}  // namespace zerodrift::diagnosis
