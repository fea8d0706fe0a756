#include "core/diagnosis/answer/assess.h"

#include <algorithm>

#include "core/diagnosis/answer/channel_reports.h"
#include "core/diagnosis/answer/detectable.h"
#include "core/diagnosis/answer/experiment.h"
#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/answer/fitted_description.h"
#include "core/diagnosis/answer/found_effects.h"
#include "core/diagnosis/answer/held_out.h"
#include "core/diagnosis/answer/mismatch.h"
#include "core/diagnosis/answer/mistakes.h"
#include "core/diagnosis/answer/notes.h"
#include "core/diagnosis/answer/weighed.h"

namespace zerodrift::diagnosis::answer {

using inference::Fit;
using inference::HeldEffect;
using search::Explanation;
using search::Posterior;

namespace {

void tell_rivals(const Weighed& weighed, Diagnosis& answer) {
  std::set<std::string> ids;
  for (const Explanation& one : weighed.posterior.explanations) {
    for (const HeldEffect& effect : one.fit->model().hypothesis().effects) {
      const Name name = name_of(effect);
      if (weighed.named.count(name) != 0 || weighed.mass_of(name) < weighed.settings.rival_from ||
          !ids.insert(name.id).second)
        continue;
      Rival rival;
      rival.id = name.id;
      rival.component = name.component;
      rival.channel = name.channel;
      rival.behind = weighed.posterior.explanations.front().log_posterior - one.log_posterior;
      rival.why = explain_rival(rival);
      answer.ambiguous_with.push_back(std::move(rival));
    }
  }
}

void tell_tried(const Weighed& weighed, Diagnosis& answer) {
  for (std::size_t i = 0; i < weighed.probability.size(); ++i) {
    const Explanation& one = weighed.posterior.explanations[i];
    Tried tried;
    for (const HeldEffect& held : one.fit->model().hypothesis().effects) tried.effects.push_back(held.spec.id);
    for (const DescriptionError& error : one.fit->model().hypothesis().errors)
      tried.mistakes.emplace_back(diagnosis::name_of(code_of(error)));
    std::sort(tried.effects.begin(), tried.effects.end());
    tried.probability = weighed.probability[i];
    tried.behind = weighed.posterior.explanations.front().log_posterior - one.log_posterior;
    answer.tried.push_back(std::move(tried));
  }
}

void tell_verdict(const Weighed& weighed, Diagnosis& answer) {
  const auto worst = std::max_element(answer.channels.begin(), answer.channels.end(), [](const auto& a, const auto& b) {
    return a.excess_refitted < b.excess_refitted;
  });
  const bool any = std::any_of(answer.channels.begin(), answer.channels.end(),
                               [](const auto& one) { return one.verdict == ChannelVerdict::unexplained; });
  if (answer.effects.empty()) {
    // The description is not right for certain, and no one explanation of it is likely enough.
    const bool missing = weighed.probability[weighed.posterior.described] < 1.0 - weighed.decisive();
    answer.verdict = any || missing ? Verdict::unexplained : Verdict::consistent;
    return;
  }
  // What is named carries the largest mismatch, or it does not explain the recording.
  const bool carried = worst == answer.channels.end() || worst->verdict != ChannelVerdict::unexplained ||
                       worst->excess_explained < 0.5 * worst->excess_refitted;
  answer.verdict = carried ? Verdict::missing_effect : Verdict::unexplained;
}

void tell_details(const Weighed& weighed, Diagnosis& answer) {
  answer.detectable = detection_limits(weighed.posterior);
  // Best against what it cannot be told from.
  std::vector<const Fit*> rivals;
  for (const Rival& rival : answer.ambiguous_with) {
    const auto holds = [&](const Explanation& one) {
      const std::set<Name> names = names_of(one);
      return names.count({rival.id, rival.component, rival.channel}) != 0;
    };
    const auto& all = weighed.posterior.explanations;
    const auto at = std::find_if(all.begin(), all.end(), holds);
    if (at != all.end() && at->fit.get() != weighed.posterior.explanations.front().fit.get())
      rivals.push_back(at->fit.get());
    if (!rivals.empty()) break;
  }
  if (!rivals.empty()) answer.suggested = suggest_experiment(weighed.best, rivals);
}

void tell_sentences(const Weighed& weighed, Diagnosis& answer) {
  std::vector<Sentence>& told = answer.sentences;
  told.push_back(explain_verdict(answer));
  for (Sentence& one : explain_unexplained(answer)) told.push_back(std::move(one));
  if (Sentence left = explain_left(answer); !left.id.empty()) told.push_back(std::move(left));
  for (const Note& note : answer.notes) {
    // The verdict says that alone.
    if (note.code == NoteCode::described_not_there && answer.doubtful) continue;
    if (Sentence one = sentence_of(note); !one.id.empty()) told.push_back(std::move(one));
  }
  if (!weighed.described.tolerances.raised.empty()) told.push_back(explain_raised(weighed.described.tolerances));
  for (Sentence& one : explain_findings(answer.findings, answer.notes)) told.push_back(std::move(one));
}

}  // namespace

Diagnosis assess(const Posterior& posterior, const physics::Machine& described, const CheckedRuns& runs,
                 const DiagnoseOptions& options) {
  const Weighed weighed(posterior, described, runs, options);
  Diagnosis answer;
  answer.refined = fitted_description(weighed.best);
  answer.findings = runs.findings;
  answer.time_s = runs.recordings.front().time_s;
  answer.channels = channel_reports(weighed, answer.refined);
  for (const ChannelReport& one : answer.channels) {
    answer.excess_before = std::max(answer.excess_before, one.excess_refitted);
    answer.excess_after = std::max(answer.excess_after, one.excess_explained);
  }
  answer.effects = found_effects(weighed, answer.channels);
  tell_rivals(weighed, answer);
  tell_tried(weighed, answer);
  tell_verdict(weighed, answer);
  tell_mismatch(weighed, answer);
  answer.held_out = held_out(weighed);
  tell_mistakes(posterior, weighed.probability, answer);
  if (answer.verdict == Verdict::consistent) answer.mismatch = {};
  if (options.details) tell_details(weighed, answer);
  add_notes(weighed, answer);
  tell_sentences(weighed, answer);
  return answer;
}

}  // namespace zerodrift::diagnosis::answer
