#include "core/diagnosis/answer/held_out.h"

#include "core/diagnosis/answer/fitted_description.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis::answer {

using inference::Evidence;
using inference::Fit;
using inference::HeldEffect;

namespace {

/// What an explanation makes of the recordings but `run`. What happened once is not predicted elsewhere.
physics::Machine without_run(const Fit& fit, std::size_t run, const std::shared_ptr<const Evidence>& others) {
  inference::Hypothesis hypothesis = fit.model().hypothesis();
  const int left_out = static_cast<int>(run);
  std::erase_if(hypothesis.effects, [&](const HeldEffect& held) { return held.run == left_out; });
  for (HeldEffect& held : hypothesis.effects) held.run -= held.run > left_out ? 1 : 0;
  Fit rest(std::make_shared<inference::JointModel>(std::move(hypothesis), others), fit.sizes());
  rest.start_from(fit, false);
  rest.fit({others->settings().iterations, true});
  return fitted_description(rest, -1);
}

}  // namespace

std::vector<HeldOut> held_out(const PosteriorSummary& summary) {
  std::vector<HeldOut> list;
  for (std::size_t r = 1; r < summary.recordings.size(); ++r) {
    std::vector<recording::Recording> others = summary.recordings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(r));
    const auto evidence = std::make_shared<const Evidence>(summary.evidence.machine(), others, summary.settings);
    HeldOut out;
    out.recording = summary.recordings[r].name;
    const auto put = [&](const physics::Machine& machine, std::map<std::string, double>& rms,
                         const recording::Recording& run) {
      const auto result = physics::simulate(machine, run);
      if (!result) return;
      for (const auto& one : physics::compare(result->prediction, summary.recordings[r])) rms[one.channel] = one.rms;
    };
    put(summary.described, out.nominal, summary.recordings[r]);
    put(without_run(summary.base, r, evidence), out.refitted, summary.recordings[r]);
    put(without_run(summary.best, r, evidence), out.explained, summary.driven(summary.recordings[r]));
    list.push_back(std::move(out));
  }
  return list;
}

}  // namespace zerodrift::diagnosis::answer
