#pragma once
// The posterior as the answer reads it: which effects are named, the machine with these, the description alone, what
// either leaves of each channel, and how much of the probability holds an effect.

#include <set>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/input/checked_runs.h"
#include "core/diagnosis/search/stepwise_search.h"

namespace zerodrift::diagnosis::answer {

/// What is named: an effect on a part or a channel, whatever its place, law or figures.
struct Name {
  std::string id, component, channel;
  bool operator<(const Name& other) const {
    return std::tie(id, component, channel) < std::tie(other.id, other.component, other.channel);
  }
};

Name name_of(const inference::HeldEffect& effect);
std::set<Name> names_of(const search::Explanation& explanation);

/// Root mean square of what a fit leaves of a series beyond its noise, over all runs; with what is new in each
/// recording fitted.
double leftover(const inference::Fit& fit, std::size_t series);

struct PosteriorSummary {
  /// Refers to all that it is given.
  PosteriorSummary(const search::Posterior& posterior, const physics::Machine& described, const CheckedRuns& runs,
                   const DiagnoseOptions& options);

  double mass_of(const Name& name) const;
  /// Probability from which something is certain enough to act on.
  double decisive() const;
  /// In how many ways, effects and mistakes, the machine differs from its description at least: as many as are
  /// decisively more likely than fewer.
  std::size_t certainly_off() const;
  /// Does the description, as near as it comes, leave no more of any channel than good ones do?
  bool description_is_adequate() const;
  /// Log odds that the likeliest explanation loses without this effect: against the best one that has it not.
  double gain_of(const Name& name) const;
  /// What a good description leaves of a channel: settings.adequate_*.
  double allowed(std::size_t series) const;
  /// What the answer takes of a series beyond a lesser one, rms.
  double taken(const inference::Fit& less, std::size_t series) const;
  /// The answer without these effects, fitted anew.
  inference::Fit without(const std::set<Name>& names) const;
  /// With its inputs at the times at which the answer has them.
  recording::Recording driven(const recording::Recording& run) const;
  /// Those of the channels that are reported: measured in the first recording.
  std::vector<std::size_t> reported() const;

  const search::Posterior& posterior;
  const inference::Evidence& evidence;
  const DiagnosisSettings& settings;
  inference::Fit base;  // the description alone, as near as it comes
  const physics::Machine& described;
  const CheckedRuns& runs;
  const std::vector<recording::Recording>& recordings;
  const DiagnoseOptions& options;
  std::vector<double> probability;  // of each explanation
  std::set<Name> named;             // effects that are certain enough to be told
  inference::Fit best;              // the likeliest explanation with these effects alone

 private:
  bool is_material(const inference::Fit& more, const inference::Fit& less) const;
  std::set<Name> effects_to_name() const;
  inference::Fit answer() const;
};

}  // namespace zerodrift::diagnosis::answer
