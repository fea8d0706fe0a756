#include "core/diagnosis/answer/detectable.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/search/candidates.h"
#include "core/diagnosis/search/run_facts.h"
#include "core/diagnosis/search/score_test.h"

namespace zerodrift::diagnosis::answer {
namespace {

constexpr double shows_from = 5.0;  // standard deviations

const inference::Fit& described_fit(const search::Posterior& posterior) {
  return *posterior.explanations[posterior.described].fit;
}

std::vector<physics::RunFacts> facts_of(const inference::Evidence& evidence) {
  std::vector<physics::RunFacts> facts;
  for (const auto& run : evidence.runs()) facts.push_back(search::run_facts(evidence.machine(), run.recording));
  return facts;
}

/// Key of the first amplitude that this form has.
std::string amplitude_of(const physics::EffectSpec& spec) {
  for (const auto& parameter : physics::find_effect(spec.id)->parameters) {
    if (parameter.amplitude && spec.numbers.count(std::string(parameter.key)) != 0) return std::string(parameter.key);
  }
  return {};
}

}  // namespace

namespace {

/// Of each effect its best form beside a fit.
std::map<std::string, Detectable> limits_beside(const inference::Fit& fit) {
  const auto candidates = search::candidates_for(fit.model().hypothesis(), facts_of(fit.model().evidence()), 0.0);
  const auto scores = search::score_test(fit, candidates);
  const double full_rpm = fit.model().network(0).full_speed_rpm;
  std::map<std::string, Detectable> least;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const physics::EffectSpec& spec = candidates[i].effect.spec;
    // Of the information the prior is one; what is left are the data's standard deviations.
    const double data = 1.0 / (scores[i].sigma * scores[i].sigma) - 1.0;
    if (!(scores[i].usual > 0.0) || !(data > 1e-9)) continue;
    const double value = shows_from * scores[i].usual / std::sqrt(data);
    Detectable& kept = least[spec.id];
    if (!kept.id.empty() && value >= kept.value) continue;
    kept = {spec.id, amplitude_of(spec), value, scores[i].usual};
    const auto at = speeds_of_figures(spec.numbers, spec.words, full_rpm);
    if (at.count(kept.key) != 0) kept.at_rpm = at.at(kept.key);
  }
  return least;
}

}  // namespace

std::vector<Detectable> detection_limits(const search::Posterior& posterior) {
  std::map<std::string, Detectable> least = limits_beside(described_fit(posterior));
  // What could not be there before something else was.
  if (posterior.described != 0) least.merge(limits_beside(*posterior.explanations.front().fit));
  std::vector<Detectable> list;
  for (auto& [id, one] : least) list.push_back(std::move(one));
  return list;
}

std::vector<std::string> never_driven(const search::Posterior& posterior, const std::vector<Detectable>& limits) {
  const inference::Evidence& evidence = *posterior.evidence;
  const physics::RunFacts facts = search::merged(facts_of(evidence));
  const auto logged = [&](const char* column) {
    return std::any_of(evidence.runs().begin(), evidence.runs().end(),
                       [&](const auto& run) { return run.recording.find(column) != nullptr; });
  };
  physics::RunFacts all = facts;
  all.has_speed = all.has_speed || logged("spindle_rpm");
  all.has_coolant = all.has_coolant || logged("coolant_on");
  all.has_load = all.has_load || logged("spindle_load_W");
  std::vector<std::string> asleep;
  for (const physics::Effect* effect : physics::all_effects()) {
    const std::string id(effect->id);
    if (physics::find_effect(id)->traits.log_rarity < 0.0) continue;
    // More forms of it is enough: a coolant that never ran may be there beside one that always does.
    const auto& machine = evidence.machine();
    if (effect->candidates(machine, all).size() > effect->candidates(machine, facts).size() &&
        std::none_of(limits.begin(), limits.end(), [&](const Detectable& one) { return one.id == id; })) {
      asleep.push_back(id);
    }
  }
  return asleep;
}

bool shows_too_little(const search::Posterior& posterior, const std::vector<Detectable>& limits) {
  const inference::Evidence& evidence = *posterior.evidence;
  bool temperature = false;
  for (std::size_t c = 0; c < evidence.series(); ++c)
    temperature |= evidence.samples(c) > 0 && evidence.runs().front().series[c].temperature;
  if (!temperature) return true;
  const auto hidden =
      std::count_if(limits.begin(), limits.end(), [](const Detectable& one) { return one.value > one.usual; });
  return 2 * hidden > std::ssize(limits);
}

std::vector<std::string> cannot_show(const Diagnosis& answer) {
  std::vector<std::string> unseen;
  for (const Detectable& least : answer.detectable) {
    const bool named = std::any_of(answer.effects.begin(), answer.effects.end(),
                                   [&](const auto& found) { return found.id == least.id; });
    if (named || least.key.empty() || physics::find_effect(least.id)->traits.log_rarity < 0.0) continue;
    if (least.value > physics::find_effect(least.id)->parameter(least.key).high) unseen.push_back(least.id);
  }
  return unseen;
}

}  // namespace zerodrift::diagnosis::answer
