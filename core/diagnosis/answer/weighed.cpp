#include "core/diagnosis/answer/weighed.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace zerodrift::diagnosis::answer {

using inference::Evidence;
using inference::Fit;
using inference::HeldEffect;
using search::Explanation;
using search::Posterior;

namespace {

/// Posterior probability of each explanation.
std::vector<double> probabilities(const Posterior& posterior, double tempering) {
  std::vector<double> p;
  double sum = 0.0;
  for (const Explanation& one : posterior.explanations) {
    p.push_back(std::exp(tempering * (one.log_posterior - posterior.explanations.front().log_posterior)));
    sum += p.back();
  }
  for (double& one : p) one /= sum;
  return p;
}

/// Fitted as if it left no more than such descriptions usually do: where the discrepancy may be any size, a fit that is
/// far off has no reason to come nearer.
Fit at_usual_sizes(const Fit& start) {
  Fit fit(start);
  fit.set_sizes(fit.model().evidence().usual_sizes());
  fit.fit({fit.model().evidence().settings().iterations, true});
  return fit;
}

}  // namespace

Name name_of(const HeldEffect& effect) {
  return {effect.spec.id, effect.spec.word_or("component", ""), effect.spec.word_or("channel", "")};
}

std::set<Name> names_of(const Explanation& explanation) {
  std::set<Name> names;
  for (const HeldEffect& effect : explanation.fit->model().hypothesis().effects) names.insert(name_of(effect));
  return names;
}

double leftover(const Fit& fit, std::size_t series) {
  const Evidence& evidence = fit.model().evidence();
  double sum = 0.0;
  int count = 0;
  for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
    const inference::MeasuredSeries& measured = evidence.runs()[r].series[series];
    for (std::size_t k = 0; k < measured.values.size(); ++k) {
      if (!measured.present[k]) continue;
      const double off = measured.values[k] - fit.predicted()[r][series][k];
      sum += off * off - measured.white * measured.white;
      ++count;
    }
  }
  return count == 0 ? 0.0 : std::sqrt(std::max(0.0, sum / count));
}

Weighed::Weighed(const Posterior& of, const physics::Machine& machine, const CheckedRuns& checked,
                 const DiagnoseOptions& wanted)
    : posterior(of),
      evidence(*of.evidence),
      settings(evidence.settings()),
      best(*of.explanations.front().fit),
      base(at_usual_sizes(*of.described_straight)),
      described(machine),
      runs(checked),
      recordings(checked.recordings),
      options(wanted),
      probability(probabilities(of, settings.tempering)) {}

double Weighed::mass_of(const Name& name) const {
  double mass = 0.0;
  for (std::size_t i = 0; i < probability.size(); ++i) {
    if (names_of(posterior.explanations[i]).count(name) != 0) mass += probability[i];
  }
  return mass;
}

double Weighed::gain_of(const Name& name) const {
  for (const Explanation& one : posterior.explanations) {
    if (names_of(one).count(name) == 0) return posterior.explanations.front().log_posterior - one.log_posterior;
  }
  return settings.margin;
}

double Weighed::allowed(std::size_t series) const {
  const bool coarse = evidence.is_coarse(series);
  const double slow = evidence.runs().front().series[series].slow;
  return std::hypot((coarse ? settings.adequate_coarse_size : settings.adequate_size) * slow,
                    (coarse ? settings.adequate_coarse_share : settings.adequate_share) * evidence.range(series));
}

double Weighed::taken(const Fit& less, std::size_t series) const {
  const double before = leftover(less, series), after = leftover(best, series);
  return std::sqrt(std::max(0.0, before * before - after * after));
}

Fit Weighed::without(const std::set<Name>& names) const {
  inference::Hypothesis hypothesis = best.model().hypothesis();
  std::erase_if(hypothesis.effects, [&](const HeldEffect& held) { return names.count(name_of(held)) != 0; });
  Fit fit(std::make_shared<inference::JointModel>(std::move(hypothesis), best.model().shared_evidence()), best.sizes());
  fit.start_from(best, false);
  fit.fit({settings.iterations, true});
  return fit;
}

recording::Recording Weighed::driven(const recording::Recording& run) const {
  return set_right(run, best.model().hypothesis().errors);
}

std::vector<std::size_t> Weighed::reported() const {
  std::vector<std::size_t> list;
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    const bool measured = recordings.front().find(evidence.runs().front().series[c].channel) != nullptr;
    if (evidence.samples(c) > 0 && measured) list.push_back(c);
  }
  return list;
}

}  // namespace zerodrift::diagnosis::answer
