#include "core/diagnosis/place.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/parallel.h"
#include "core/diagnosis/screening.h"

namespace zerodrift::diagnosis {
namespace {

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
  constexpr FitOptions brief = {8, 0.05, false};
  auto known = std::make_unique<Model>(with_place(fit.machine(), effect, at_mm), fit.shared_data());
  known->start_from(fit, true);
  known->fit(brief);
  double evidence = known->log_evidence();
  for (const ModelPtr& other : others.fits) {
    auto there = std::make_unique<Model>(with_place(fit.machine(), effect, at_mm), other->shared_data());
    there->start_from(*other, true);
    there->learn_from(*known, others.sensors);
    there->fit(brief);
    evidence += there->log_evidence();
    known = std::move(there);
  }
  return evidence;
}

/// Places to try: close ones about the fit's, by its own width, and where that is wide a few all along, for other
/// peaks.
std::vector<double> places_about(double at_mm, double width_mm, double low_mm, double high_mm) {
  constexpr int to_a_side = 6;
  constexpr double apart = 0.65;  // of the width
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
  const std::vector<double> at_mm = places_about(last.value(*unknown), width_mm, place.low, place.high);
  std::vector<double> evidence(at_mm.size());
  in_parallel(at_mm.size(), [&](std::size_t i) { evidence[i] = evidence_at(fit, others, effect, at_mm[i]); });
  return place_from(at_mm, evidence);
}

}  // namespace zerodrift::diagnosis
