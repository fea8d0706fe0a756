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
#include "core/diagnosis/answer/posterior_summary.h"

namespace zerodrift::diagnosis::answer {

using inference::Fit;
using inference::HeldEffect;
using search::Explanation;
using search::Posterior;

namespace {

void report_rivals(const PosteriorSummary& summary, Diagnosis& answer) {
  std::set<std::string> ids;
  for (const Explanation& one : summary.posterior.explanations) {
    for (const HeldEffect& effect : one.fit->model().hypothesis().effects) {
      const Name name = name_of(effect);
      if (summary.named.count(name) != 0 || summary.mass_of(name) < summary.settings.rival_from ||
          !ids.insert(name.id).second)
        continue;
      Rival rival;
      rival.id = name.id;
      rival.component = name.component;
      rival.channel = name.channel;
      rival.behind = summary.posterior.explanations.front().log_posterior - one.log_posterior;
      rival.why = explain_rival(rival);
      answer.ambiguous_with.push_back(std::move(rival));
    }
  }
}

void report_tried(const PosteriorSummary& summary, Diagnosis& answer) {
  for (std::size_t i = 0; i < summary.probability.size(); ++i) {
    const Explanation& one = summary.posterior.explanations[i];
    Tried tried;
    for (const HeldEffect& held : one.fit->model().hypothesis().effects) tried.effects.push_back(held.spec.id);
    for (const DescriptionError& error : one.fit->model().hypothesis().errors)
      tried.mistakes.emplace_back(diagnosis::name_of(code_of(error)));
    std::sort(tried.effects.begin(), tried.effects.end());
    tried.probability = summary.probability[i];
    tried.behind = summary.posterior.explanations.front().log_posterior - one.log_posterior;
    answer.tried.push_back(std::move(tried));
  }
}

void report_verdict(const PosteriorSummary& summary, Diagnosis& answer) {
  const auto worst = std::max_element(answer.channels.begin(), answer.channels.end(), [](const auto& a, const auto& b) {
    return a.excess_refitted < b.excess_refitted;
  });
  const bool any = std::any_of(answer.channels.begin(), answer.channels.end(),
                               [](const auto& one) { return one.verdict == ChannelVerdict::unexplained; });
  if (answer.effects.empty()) {
    // The description is not right for certain, and no one explanation of it is likely enough.
    const bool missing = summary.probability[summary.posterior.described] < 1.0 - summary.decisive();
    answer.verdict = any || missing ? Verdict::unexplained : Verdict::consistent;
    return;
  }
  // What is named carries the largest mismatch, or it does not explain the recording.
  const bool carried = worst == answer.channels.end() || worst->verdict != ChannelVerdict::unexplained ||
                       worst->excess_explained < 0.5 * worst->excess_refitted;
  answer.verdict = carried ? Verdict::missing_effect : Verdict::unexplained;
}

void report_details(const PosteriorSummary& summary, Diagnosis& answer) {
  answer.detectable = detection_limits(summary.posterior);
  // Best against what it cannot be told from.
  std::vector<const Fit*> rivals;
  for (const Rival& rival : answer.ambiguous_with) {
    const auto holds = [&](const Explanation& one) {
      const std::set<Name> names = names_of(one);
      return names.count({rival.id, rival.component, rival.channel}) != 0;
    };
    const auto& all = summary.posterior.explanations;
    const auto at = std::find_if(all.begin(), all.end(), holds);
    if (at != all.end() && at->fit.get() != summary.posterior.explanations.front().fit.get())
      rivals.push_back(at->fit.get());
    if (!rivals.empty()) break;
  }
  if (!rivals.empty()) answer.suggested = suggest_experiment(summary.best, rivals);
}

void report_sentences(const PosteriorSummary& summary, Diagnosis& answer) {
  std::vector<Sentence>& told = answer.sentences;
  told.push_back(explain_verdict(answer));
  for (Sentence& one : explain_unexplained(answer)) told.push_back(std::move(one));
  if (Sentence left = explain_left(answer); !left.id.empty()) told.push_back(std::move(left));
  for (const Note& note : answer.notes) {
    // The verdict says that alone.
    if (note.code == NoteCode::described_not_there && answer.doubtful) continue;
    if (Sentence one = sentence_of(note); !one.id.empty()) told.push_back(std::move(one));
  }
  if (!summary.described.tolerances.raised.empty()) told.push_back(explain_raised(summary.described.tolerances));
  for (Sentence& one : explain_findings(answer.findings, answer.notes)) told.push_back(std::move(one));
}

}  // namespace

Diagnosis assess(const Posterior& posterior, const physics::Machine& described, const CheckedRuns& runs,
                 const DiagnoseOptions& options) {
  const PosteriorSummary summary(posterior, described, runs, options);
  Diagnosis answer;
  answer.refined = fitted_description(summary.best);
  answer.findings = runs.findings;
  answer.time_s = runs.recordings.front().time_s;
  answer.channels = channel_reports(summary, answer.refined);
  for (const ChannelReport& one : answer.channels) {
    answer.excess_before = std::max(answer.excess_before, one.excess_refitted);
    answer.excess_after = std::max(answer.excess_after, one.excess_explained);
  }
  answer.effects = found_effects(summary, answer.channels);
  report_rivals(summary, answer);
  report_tried(summary, answer);
  report_verdict(summary, answer);
  report_mismatch(summary, answer);
  answer.held_out = held_out(summary);
  report_mistakes(posterior, summary.probability, answer);
  if (answer.verdict == Verdict::consistent) answer.mismatch = {};
  if (options.details) report_details(summary, answer);
  add_notes(summary, answer);
  report_sentences(summary, answer);
  return answer;
}

}  // namespace zerodrift::diagnosis::answer
