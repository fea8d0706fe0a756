#include "app/proof/oracle.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/diagnosis/answer/fitted_description.h"
#include "core/diagnosis/description/inner_bodies.h"
#include "core/diagnosis/search/candidates.h"
#include "core/diagnosis/search/run_facts.h"
#include "core/diagnosis/search/score_test.h"
#include "core/physics/simulate.h"

namespace zerodrift::proof {
namespace {

using diagnosis::inference::Evidence;
using diagnosis::inference::Fit;
using diagnosis::inference::Hypothesis;
using diagnosis::inference::JointModel;
using diagnosis::search::Candidate;
using FitPtr = std::shared_ptr<Fit>;

bool is_form_of(const Candidate& candidate, const TrueEffect& hidden) {
  const auto& spec = candidate.effect.spec;
  // On a rod a heat that is always there is a source with a constant law.
  if (hidden.id == "standing_heat" && spec.id == "extra_heat_source") return spec.word_or("law", "") == "constant";
  if (spec.id != hidden.id) return false;
  if (!hidden.channel.empty() && spec.word_or("channel", "") != hidden.channel) return false;
  return hidden.law.empty() || spec.word_or("law", hidden.law) == hidden.law;
}

/// Started from another fit where there is one, at its sizes of the discrepancy.
FitPtr fit_of(Hypothesis hypothesis, const std::shared_ptr<const Evidence>& evidence, const Fit* start) {
  auto fit = std::make_shared<Fit>(std::make_shared<JointModel>(std::move(hypothesis), evidence),
                                   start == nullptr ? evidence->usual_sizes() : start->sizes());
  if (start != nullptr) fit->start_from(*start, false);
  return fit;
}

FitPtr fitted(Hypothesis hypothesis, const std::shared_ptr<const Evidence>& evidence, const Fit* start) {
  FitPtr fit = fit_of(std::move(hypothesis), evidence, start);
  fit->settle();
  return fit;
}

/// The best form of one hidden effect added to a fit; places start where the truth is.
FitPtr with_effect(const FitPtr& base, const TrueEffect& hidden, const std::vector<physics::RunFacts>& facts) {
  auto candidates = diagnosis::search::candidates_for(base->model().hypothesis(), facts, 0.0);
  std::erase_if(candidates, [&](const auto& candidate) { return !is_form_of(candidate, hidden); });
  for (Candidate& candidate : candidates) {
    auto& numbers = candidate.effect.spec.numbers;
    if (hidden.position_mm && numbers.count("position_mm") != 0) numbers["position_mm"] = *hidden.position_mm;
  }
  const auto scores = diagnosis::search::score_test(*base, candidates);
  std::vector<std::size_t> order(candidates.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return scores[a].log_odds > scores[b].log_odds; });
  constexpr std::size_t forms = 4;
  if (order.size() > forms) order.resize(forms);
  FitPtr best;
  for (const std::size_t i : order) {
    Hypothesis hypothesis = base->model().hypothesis();
    hypothesis.effects.push_back(candidates[i].effect);
    const FitPtr fit = fit_of(std::move(hypothesis), base->model().shared_evidence(), base.get());
    fit->fit({12, true});
    if (best == nullptr || fit->log_evidence() > best->log_evidence()) best = fit;
  }
  if (best != nullptr) best->settle();
  return best;
}

std::map<std::string, double> reached_in(const Fit& fit, const recording::Recording& other) {
  std::map<std::string, double> reached;
  const auto simulation = physics::simulate(diagnosis::answer::fitted_description(fit, 1), other);
  if (!simulation) return reached;
  for (const auto& one : physics::compare(simulation->prediction, other)) reached[one.channel] = one.rms;
  return reached;
}

}  // namespace

OracleAnswer told_the_truth(const physics::Machine& described, const std::vector<recording::Recording>& recordings,
                            const std::vector<TrueEffect>& hidden) {
  const auto evidence = std::make_shared<const Evidence>(diagnosis::with_inner_bodies(described), recordings,
                                                         diagnosis::DiagnosisSettings{});
  std::vector<physics::RunFacts> facts;
  for (const auto& run : evidence->runs())
    facts.push_back(diagnosis::search::run_facts(evidence->machine(), run.recording));
  const FitPtr base = fitted({evidence->machine(), {}, 0.0}, evidence, nullptr);
  OracleAnswer answer;
  FitPtr best;
  std::vector<TrueEffect> in_turn = hidden;
  for (std::size_t order = 0; order < std::max<std::size_t>(1, hidden.size()); ++order) {
    FitPtr fit = base;
    for (const auto& effect : in_turn) {
      if (fit != nullptr) fit = with_effect(fit, effect, facts);
    }
    if (fit == nullptr) return answer;
    if (best == nullptr || fit->log_evidence() > best->log_evidence()) best = fit;
    std::reverse(in_turn.begin(), in_turn.end());
  }
  answer.found = true;
  answer.evidence = best->log_evidence() - base->log_evidence();
  const auto& held = best->model().hypothesis().effects;
  for (std::size_t e = 0; e < held.size(); ++e) {
    Hypothesis less = best->model().hypothesis();
    less.effects.erase(less.effects.begin() + static_cast<std::ptrdiff_t>(e));
    answer.beside[held[e].spec.id] =
        best->log_evidence() - fitted(std::move(less), evidence, best.get())->log_evidence();
    std::map<std::string, double> sigma;
    diagnosis::answer::fitted_effect(*best, e, &sigma);
    if (sigma.count("position_mm") != 0) answer.place_sigma_mm[held[e].spec.id] = sigma["position_mm"];
  }
  if (recordings.size() > 1) answer.reached = reached_in(*best, recordings[1]);
  return answer;
}

}  // namespace zerodrift::proof
