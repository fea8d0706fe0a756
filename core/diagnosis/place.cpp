#include "core/diagnosis/place.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/diagnosis/parallel.h"
#include "core/diagnosis/screening.h"

namespace zerodrift::diagnosis {
namespace {

constexpr int to_a_side = 6;    // places beside the fit's
constexpr double apart = 0.65;  // of its width

/// The unknown that is the effect's place.
std::optional<std::size_t> place_unknown(const Model& model, std::size_t effect) {
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    if (model.unknown(i).effect == static_cast<int>(effect) && model.unknown(i).key == "position_mm") return i;
  }
  return std::nullopt;
}

physics::Machine with_place(physics::Machine machine, std::size_t effect, double at_mm) {
  machine.effects[effect].numbers["position_mm"] = at_mm;
  machine.effects[effect].numbers["position_mm_prior_sigma"] = 0.0;
  return machine;
}

double evidence_at(const Model& fit, const SeenByAll& others, std::size_t effect, double at_mm) {
  // Places are compared by a few tenths of evidence: what stops short of the bottom leans to where it started.
  constexpr FitOptions whole = {15, 0.05, true, true};
  auto known = std::make_unique<Model>(with_place(fit.machine(), effect, at_mm), fit.shared_data());
  known->start_from(fit, true);
  known->fit(whole);
  double evidence = known->log_evidence();
  for (const ModelPtr& other : others.fits) {
    auto there = std::make_unique<Model>(with_place(fit.machine(), effect, at_mm), other->shared_data());
    there->start_from(*other, true);
    there->learn_from(*known, others.sensors);
    there->fit(whole);
    evidence += there->log_evidence();
    known = std::move(there);
  }
  return evidence;
}

/// Places to try: close ones about the fit's, by its own width, and where that is wide a few all along, for other
/// peaks.
std::vector<double> places_about(double at_mm, double width_mm, double low_mm, double high_mm) {
  constexpr int all_along = 12;
  constexpr double wide = 0.015;  // of all places
  std::vector<double> list;
  for (int i = -to_a_side; i <= to_a_side; ++i)
    list.push_back(std::clamp(at_mm + apart * i * width_mm, low_mm, high_mm));
  const int further = width_mm > wide * (high_mm - low_mm) ? all_along : 0;
  for (int i = 0; i < further; ++i) list.push_back(std::lerp(low_mm, high_mm, i / (all_along - 1.0)));
  std::sort(list.begin(), list.end());
  const double same_mm = 0.1 * width_mm;
  list.erase(std::unique(list.begin(), list.end(), [=](double a, double b) { return b - a < same_mm; }), list.end());
  return list;
}

/// As many again beyond an end of the list that is nearly as likely as the likeliest: the fit had stopped short of it.
std::vector<double> places_beyond(const std::map<double, double>& evidence, double width_mm, double low_mm,
                                  double high_mm) {
  constexpr double as_likely = 5.0;  // three widths of a normal distribution are 4.5 behind
  double largest = evidence.begin()->second;
  for (const auto& [at_mm, value] : evidence) largest = std::max(largest, value);
  const auto [first_mm, of_first] = *evidence.begin();
  const auto [last_mm, of_last] = *evidence.rbegin();
  std::vector<double> list;
  for (int i = 1; i <= to_a_side; ++i) {
    const double step_mm = apart * i * width_mm;
    if (of_first > largest - as_likely) list.push_back(std::max(low_mm, first_mm - step_mm));
    if (of_last > largest - as_likely) list.push_back(std::min(high_mm, last_mm + step_mm));
  }
  std::erase_if(list, [&](double at_mm) { return evidence.count(at_mm) != 0; });
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

}  // namespace

Place place_from(const std::vector<double>& position_mm, const std::vector<double>& log_evidence) {
  constexpr int parts = 40;  // of each stretch between two places
  const double largest = *std::max_element(log_evidence.begin(), log_evidence.end());
  std::vector<std::pair<double, double>> share;  // place, weight
  double sum = 0.0;
  for (std::size_t i = 0; i + 1 < position_mm.size(); ++i) {
    const double step_mm = (position_mm[i + 1] - position_mm[i]) / parts;
    for (int k = 0; k < parts; ++k) {
      const double at = (k + 0.5) / parts;
      const double evidence = std::lerp(log_evidence[i], log_evidence[i + 1], at);
      share.emplace_back(std::lerp(position_mm[i], position_mm[i + 1], at), step_mm * std::exp(evidence - largest));
      sum += share.back().second;
    }
  }
  Place place;
  for (const auto& [at, weight] : share) place.mean_mm += at * weight / sum;
  double variance = 0.0;
  for (const auto& [at, weight] : share) variance += (at - place.mean_mm) * (at - place.mean_mm) * weight / sum;
  place.sigma_mm = std::sqrt(variance);
  constexpr double outside = 0.025;
  double below = 0.0;
  place.from_mm = place.to_mm = share.front().first;
  for (const auto& [at, weight] : share) {
    if (below < outside) place.from_mm = at;
    if (below < 1.0 - outside) place.to_mm = at;
    below += weight / sum;
  }
  return place;
}

std::optional<Place> place_of_effect(const Model& fit, const SeenByAll& others, std::size_t effect) {
  const Model& last = others.fits.empty() ? fit : *others.fits.back();
  const auto unknown = place_unknown(last, effect);
  if (!unknown) return std::nullopt;
  const physics::Parameter& place = last.unknown(*unknown);
  // The fit's place was held near where it had started; without that its width is wider.
  constexpr double least_known = 0.05;
  const double held = std::min(1.0 - least_known, std::pow(last.sigma(*unknown) / place.sigma, 2));
  const double width_mm = last.sigma(*unknown) / std::sqrt(1.0 - held);
  std::vector<double> turn = places_about(last.value(*unknown), width_mm, place.low, place.high);
  std::map<double, double> evidence;  // by place
  constexpr int rounds = 5;
  for (int round = 0; round < rounds && !turn.empty(); ++round) {
    std::vector<double> found(turn.size());
    in_parallel(turn.size(), [&](std::size_t i) { found[i] = evidence_at(fit, others, effect, turn[i]); });
    for (std::size_t i = 0; i < turn.size(); ++i) evidence.emplace(turn[i], found[i]);
    turn = places_beyond(evidence, width_mm, place.low, place.high);
  }
  std::vector<double> at_mm, log_evidence;
  for (const auto& [at, value] : evidence) at_mm.push_back(at), log_evidence.push_back(value);
  return place_from(at_mm, log_evidence);
}

}  // namespace zerodrift::diagnosis
