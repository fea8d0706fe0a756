#include "core/analysis/sensor_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/analysis/budget.h"
#include "core/analysis/evaluate.h"

namespace zerodrift::analysis {
namespace {

using Names = std::vector<std::string>;

/// Beyond the small sets: room for sensors that repeat each other, whose mean is quieter.
constexpr std::size_t more_sensors = 3;

Names first_of(const Names& order, std::size_t count) {
  return {order.begin(), order.begin() + static_cast<std::ptrdiff_t>(std::min(order.size(), count))};
}

Names filled_up(Names names, const Names& order, std::size_t count) {
  for (const auto& name : order) {
    if (names.size() >= count) break;
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

/// The sets to compare, each once, from few to many; none larger than allowed.
std::vector<SensorSet> sets_to_try(const TrainingSet& set, const ChoiceOptions& options, const Names& spread,
                                   const Names& nearest) {
  const std::size_t few = options.few;
  std::vector<SensorSet> sets;
  std::set<std::set<std::string>> seen;
  const auto add = [&](SetKind kind, Names names) {
    if (names.empty() || (options.most > 0 && names.size() > options.most)) return;
    if (seen.insert({names.begin(), names.end()}).second) {
      SensorSet& added = sets.emplace_back();
      added.kind = kind;
      added.sensors = std::move(names);
    }
  };
  Names points = options.sensitive_points;
  std::erase_if(points, [&](const auto& p) { return std::find(spread.begin(), spread.end(), p) == spread.end(); });
  add(SetKind::sensitive_points, points);
  for (const std::size_t count : {few, few + more_sensors, few + 2 * more_sensors}) {
    const std::size_t allowed = options.most > 0 ? std::min(count, options.most) : count;
    add(SetKind::spread, first_of(spread, allowed));
    add(SetKind::nearest, first_of(nearest, allowed));
  }
  if (!points.empty()) add(SetKind::sensitive_plus_spread, filled_up(points, spread, points.size() + more_sensors));
  // What one cycle is fitted on, see take_all_nearest.
  if (set.folds.cycles < 2 && options.most > 0) add(SetKind::nearest, first_of(nearest, options.most));
  add(SetKind::all, set.sensors);
  std::stable_sort(sets.begin(), sets.end(),
                   [](const auto& a, const auto& b) { return a.sensors.size() < b.sensors.size(); });
  return sets;
}

/// Whether the left-out stretches tell `set` to be worse than `best`: mean difference against its standard error.
bool told_worse(const SensorSet& set, const SensorSet& best) {
  const auto n = static_cast<double>(best.fold_um.size());
  double mean = 0.0;
  for (std::size_t f = 0; f < best.fold_um.size(); ++f) mean += (set.fold_um[f] - best.fold_um[f]) / n;
  double square = 0.0;
  for (std::size_t f = 0; f < best.fold_um.size(); ++f) {
    square += std::pow(set.fold_um[f] - best.fold_um[f] - mean, 2);
  }
  return mean > std::sqrt(square / (n - 1.0) / n);
}

/// `sets` from few sensors to many.
std::size_t best_of(const std::vector<SensorSet>& sets) {
  const auto least = std::min_element(sets.begin(), sets.end(),
                                      [](const auto& a, const auto& b) { return a.expected_um < b.expected_um; });
  auto best = static_cast<std::size_t>(least - sets.begin());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    const bool larger = sets[i].sensors.size() > sets[best].sensors.size();
    const bool as_large_and_better =
        sets[i].sensors.size() == sets[best].sensors.size() && sets[i].expected_um < sets[best].expected_um;
    if ((larger || as_large_and_better) && !told_worse(sets[i], *least)) best = i;
  }
  return best;
}

/// One cycle: the largest set there is, in the order of nearness (the sets are there to be compared; this one is taken
/// because the structural fit needs every body to have its sensor).
std::size_t take_all_nearest(std::vector<SensorSet>& sets, const Names& nearest, std::size_t most) {
  const Names taken = most > 0 ? first_of(nearest, most) : nearest;
  const auto same = std::find_if(sets.begin(), sets.end(), [&](const SensorSet& s) {
    return std::set<std::string>(s.sensors.begin(), s.sensors.end()) ==
           std::set<std::string>(taken.begin(), taken.end());
  });
  same->sensors = taken;
  return static_cast<std::size_t>(same - sets.begin());
}

std::string comparison(const std::vector<SensorSet>& sets, std::size_t chosen, const std::string& left_out) {
  const SensorSet& best = sets[chosen];
  std::string text =
      fmt::format("{} {} ({}) leave {:.2f} um rms with {} left out, {:.2f} um with the noise of single readings",
                  best.sensors.size(), best.sensors.size() == 1 ? "sensor" : "sensors", in_words(best.kind),
                  best.held_out_rms_um, left_out, best.expected_um);
  for (const auto& s : sets) {
    if (&s != &best) text += fmt::format("; {} {}: {:.2f} um", s.sensors.size(), in_words(s.kind), s.expected_um);
  }
  const auto least = std::min_element(sets.begin(), sets.end(),
                                      [](const auto& a, const auto& b) { return a.expected_um < b.expected_um; });
  if (least->expected_um < best.expected_um && best.fold_um.size() >= 2) {
    text += "; what was left out does not tell them apart, and the mean of more sensors is quieter";
  }
  return text;
}

}  // namespace

std::string_view name_of(SetKind kind) {
  switch (kind) {
    case SetKind::sensitive_points:
      return "sensitive_points";
    case SetKind::spread:
      return "spread";
    case SetKind::nearest:
      return "nearest";
    case SetKind::sensitive_plus_spread:
      return "sensitive_plus_spread";
    case SetKind::all:
      return "all";
  }
  return "";
}

std::string_view in_words(SetKind kind) {
  switch (kind) {
    case SetKind::sensitive_points:
      return "sensitive points of the clusters";
    case SetKind::spread:
      return "that differ most";
    case SetKind::nearest:
      return "nearest to the model on all";
    case SetKind::sensitive_plus_spread:
      return "sensitive points and those that differ most from them";
    case SetKind::all:
      return "all that are usable";
  }
  return "";
}

Result<SensorChoice> choose_sensor_set(const TrainingSet& set, const ChoiceOptions& options,
                                       const TaskContext& context) {
  ZD_TRY(const Names nearest, nearest_order(set));
  SensorChoice out;
  out.sets = sets_to_try(set, options, spread_order(set), nearest);
  out.one_cycle = set.folds.count < 2;
  if (out.one_cycle) out.chosen = take_all_nearest(out.sets, nearest, options.most);
  for (auto& candidate : out.sets) {
    Recipe recipe = make_recipe(Method::ridge, candidate.sensors, set);
    if (out.one_cycle && &candidate == &out.sets[out.chosen]) recipe.nested = out.nested();
    const auto judged = evaluate(set, recipe, 0.9, context);
    if (!judged) return fail(judged.error());
    candidate.held_out_rms_um = judged->rms_um;
    candidate.held_out_peak_um = judged->peak_um;
    candidate.expected_um = judged->expected_um;
    candidate.fold_um = judged->fold_um;
    candidate.noise_um = judged->mean_noise_um;
  }
  if (!out.one_cycle) out.chosen = best_of(out.sets);
  out.reason = comparison(out.sets, out.chosen, set.folds.in_words);
  if (out.one_cycle) {
    out.reason +=
        "; one cycle cannot rank them (a second speed would), so fits on the first few of them are averaged, and what "
        "the run leaves open is filled by how machines are built";
  }
  return out;
}

std::vector<std::size_t> SensorChoice::nested() const {
  if (!one_cycle || sets.empty()) return {};
  return averaged_counts(sets[chosen].sensors.size());
}

std::vector<std::size_t> averaged_counts(std::size_t sensors) {
  std::vector<std::size_t> counts;
  for (const std::size_t count : {2U, 3U, 4U, 5U, 6U, 8U}) {
    if (count <= sensors) counts.push_back(count);
  }
  if (sensors == 1 || sensors == 7) counts.push_back(sensors);  // all that were asked for have their say
  return counts;
}

nlohmann::json to_json(const SensorChoice& choice) {
  nlohmann::json sets = nlohmann::json::array();
  for (std::size_t i = 0; i < choice.sets.size(); ++i) {
    const SensorSet& s = choice.sets[i];
    sets.push_back({{"kind", name_of(s.kind)},
                    {"in_words", in_words(s.kind)},
                    {"sensors", s.sensors},
                    {"held_out_rms_um", s.held_out_rms_um},
                    {"held_out_peak_um", s.held_out_peak_um},
                    {"noise_um", s.noise_um},
                    {"expected_um", s.expected_um},
                    {"chosen", i == choice.chosen}});
  }
  return {{"reason", choice.reason}, {"sets", std::move(sets)}};
}

}  // namespace zerodrift::analysis
