#include "core/diagnosis/answer/posterior_summary.h"

#include <algorithm>
#include <cmath>
#include <iterator>
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

/// `fit` without these effects, fitted anew.
Fit reduced(const Fit& fit, const std::set<Name>& names) {
  inference::Hypothesis hypothesis = fit.model().hypothesis();
  std::erase_if(hypothesis.effects, [&](const HeldEffect& held) { return names.count(name_of(held)) != 0; });
  Fit less(std::make_shared<inference::JointModel>(std::move(hypothesis), fit.model().shared_evidence()), fit.sizes());
  less.start_from(fit, false);
  less.fit({fit.model().evidence().settings().iterations, true});
  return less;
}

double taken_by(const Fit& more, const Fit& less, std::size_t series) {
  const double before = leftover(less, series), after = leftover(more, series);
  return std::sqrt(std::max(0.0, before * before - after * after));
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

PosteriorSummary::PosteriorSummary(const Posterior& of, const physics::Machine& machine, const CheckedRuns& checked,
                                   const DiagnoseOptions& wanted)
    : posterior(of),
      evidence(*of.evidence),
      settings(evidence.settings()),
      base(at_usual_sizes(*of.described_straight)),
      described(machine),
      runs(checked),
      recordings(checked.recordings),
      options(wanted),
      probability(probabilities(of, settings.tempering)),
      named(effects_to_name()),
      best(answer()) {}

double PosteriorSummary::mass_of(const Name& name) const {
  double mass = 0.0;
  for (std::size_t i = 0; i < probability.size(); ++i) {
    if (names_of(posterior.explanations[i]).count(name) != 0) mass += probability[i];
  }
  return mass;
}

double PosteriorSummary::gain_of(const Name& name) const {
  for (const Explanation& one : posterior.explanations) {
    if (names_of(one).count(name) == 0) return posterior.explanations.front().log_posterior - one.log_posterior;
  }
  return settings.margin;
}

double PosteriorSummary::allowed(std::size_t series) const {
  const bool coarse = evidence.is_coarse(series);
  const double slow = evidence.runs().front().series[series].slow;
  return std::hypot((coarse ? settings.adequate_coarse_size : settings.adequate_size) * slow,
                    (coarse ? settings.adequate_coarse_share : settings.adequate_share) * evidence.range(series));
}

double PosteriorSummary::taken(const Fit& less, std::size_t series) const {
  return taken_by(best, less, series);
}

Fit PosteriorSummary::without(const std::set<Name>& names) const {
  return reduced(best, names);
}

double PosteriorSummary::decisive() const {
  return 1.0 / (1.0 + std::exp(-settings.decisive));
}

bool PosteriorSummary::description_is_adequate() const {
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    if (evidence.samples(c) > 0 && leftover(base, c) > allowed(c)) return false;
  }
  return true;
}

std::size_t PosteriorSummary::certainly_off() const {
  // A description that leaves more than any good one does is no alternative, however little the others are trusted.
  const double all = description_is_adequate() ? 1.0 : 1.0 - probability[posterior.described];
  std::size_t count = names_of(posterior.explanations.front()).size();
  for (; count > 0; --count) {
    double mass = 0.0;
    for (std::size_t i = 0; i < probability.size(); ++i) {
      const std::size_t mistakes = posterior.explanations[i].fit->model().hypothesis().errors.size();
      if (names_of(posterior.explanations[i]).size() + mistakes >= count) mass += probability[i];
    }
    if (mass >= decisive() * all) break;
  }
  return count;
}

/// Does `less` leave more of some channel than `more`, in proportion to what the description leaves?
bool PosteriorSummary::is_material(const Fit& more, const Fit& less) const {
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    if (evidence.samples(c) > 0 && taken_by(more, less, c) > settings.material_share * leftover(base, c)) return true;
  }
  return false;
}

/// As many as are supported, the likeliest first, each more likely than not. Those that only take details which a
/// better form of something else would take as well are left out one after the other, the least supported first.
std::set<Name> PosteriorSummary::effects_to_name() const {
  const Fit& top = *posterior.explanations.front().fit;
  const std::set<Name> all = names_of(posterior.explanations.front());
  std::vector<Name> order;
  for (const Name& name : all) {
    if (mass_of(name) >= settings.named_from) order.push_back(name);
  }
  std::stable_sort(order.begin(), order.end(), [&](const Name& a, const Name& b) { return gain_of(a) > gain_of(b); });
  order.resize(std::min(order.size(), certainly_off()));
  std::set<Name> kept(order.begin(), order.end()), out;
  std::set_difference(all.begin(), all.end(), kept.begin(), kept.end(), std::inserter(out, out.end()));
  for (auto name = order.rbegin(); name != order.rend(); ++name) {
    out.insert(*name);
    if (is_material(top, reduced(top, out))) {
      out.erase(*name);
    } else {
      kept.erase(*name);
    }
  }
  return kept;
}

Fit PosteriorSummary::answer() const {
  const Explanation& top = posterior.explanations.front();
  std::set<Name> all = names_of(top), out;
  std::set_difference(all.begin(), all.end(), named.begin(), named.end(), std::inserter(out, out.end()));
  return out.empty() ? Fit(*top.fit) : reduced(*top.fit, out);
}

recording::Recording PosteriorSummary::driven(const recording::Recording& run) const {
  return set_right(run, best.model().hypothesis().errors);
}

std::vector<std::size_t> PosteriorSummary::reported() const {
  std::vector<std::size_t> list;
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    const bool measured = recordings.front().find(evidence.runs().front().series[c].channel) != nullptr;
    if (evidence.samples(c) > 0 && measured) list.push_back(c);
  }
  return list;
}

}  // namespace zerodrift::diagnosis::answer
