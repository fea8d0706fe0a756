#include "core/diagnosis/contradiction.h"

#include <algorithm>

#include "core/diagnosis/diagnoser.h"

namespace zerodrift::diagnosis {
namespace {

/// Right descriptions miss another run by 1 to 2 (its start is known to some hundredths of a kelvin only).
constexpr double contradicted = 3.0;

double missed_by(const Diagnosis& diagnosis, const HeldOut& other) {
  double largest = 0.0;
  for (const ChannelReport& channel : diagnosis.channels) {
    const auto rms = other.explained.find(channel.channel);
    if (rms == other.explained.end()) continue;
    largest = std::max(largest, rms->second / std::max({channel.noise, channel.rms_explained, 1e-9}));
  }
  return largest;
}

}  // namespace

double missed_by(const Diagnosis& diagnosis) {
  double largest = 0.0;
  for (const HeldOut& other : diagnosis.held_out) largest = std::max(largest, missed_by(diagnosis, other));
  return largest;
}

Result<Diagnosis> settled(Diagnosis first, const physics::Machine& machine,
                          const std::vector<recording::Recording>& recordings, const DiagnoseOptions& options,
                          const TaskContext& context) {
  // A recording that shows by itself that something is missing was not too poor to show it.
  if (first.verdict == Verdict::unexplained && !first.refuted) return first;
  std::size_t worst = 0;
  double missed = contradicted;
  for (std::size_t i = 0; i < first.held_out.size(); ++i) {
    const double by = missed_by(first, first.held_out[i]);
    if (by <= missed) continue;
    missed = by;
    worst = i + 1;
  }
  if (worst == 0) return first;
  std::vector<recording::Recording> turned = recordings;
  std::swap(turned[0], turned[worst]);
  ZD_TRY(Diagnosis other, Diagnoser(machine, turned, options, context).run());
  other.seconds += first.seconds;
  // What happened once in the other recording cannot be borne out by the first.
  const bool once = std::any_of(other.effects.begin(), other.effects.end(),
                                [](const FoundEffect& effect) { return physics::happens_once(effect.id); });
  // The same explanation in both, of which one makes the other worse, is not saved by the turn.
  const bool same = other.tried == first.tried;
  const bool borne_out = other.verdict == Verdict::missing_effect && !once && !same && missed_by(other) < contradicted;
  if (!borne_out) {
    first.seconds = other.seconds;
    return first;
  }
  other.notes.push_back("fitted_instead:" + turned[0].name);
  return other;
}

}  // namespace zerodrift::diagnosis
