#include "core/diagnosis/contradiction.h"

#include <algorithm>

#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/explain.h"

namespace zerodrift::diagnosis {
namespace {

/// Right descriptions miss another run by 1 to 2 (its start is known to some hundredths of a kelvin only).
constexpr double contradicted = 3.0;

constexpr double in_order = 2.0;

double missed_by(const ChannelReport& channel, const HeldOut& other) {
  const auto rms = other.explained.find(channel.channel);
  if (rms == other.explained.end()) return 0.0;
  return rms->second / std::max({channel.noise, channel.rms_explained, 1e-9});
}

double missed_by(const Diagnosis& diagnosis, const HeldOut& other) {
  double largest = 0.0;
  for (const ChannelReport& channel : diagnosis.channels) largest = std::max(largest, missed_by(channel, other));
  return largest;
}

bool happened_once(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(),
                     [](const FoundEffect& effect) { return physics::happens_once(effect.id); });
}

/// Bearings that still run in do so in the next recording too, which can bear that out; doors and slips it cannot.
bool cannot_be_borne_out(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(), [](const FoundEffect& effect) {
    return physics::happens_once(effect.id) && effect.id != "bearing_run_in";
  });
}

/// Both bearings or one of them: the same explanation, less well known.
std::string at_some_bearing(std::string form) {
  const std::size_t at = form.find(" bearing=");
  if (at != std::string::npos) form.erase(at, form.find(' ', at + 1) - at);
  return form;
}

/// Two recordings, each by itself, came to the same effects of about the same size, and one of them is explained by
/// them: what the prediction of the other misses then is how well their parameters and starts are known. Not where they
/// live by a start of their own in each recording: so would anything that drifts.
bool found_twice(const Diagnosis& first, const Diagnosis& other) {
  constexpr double ordinary = 2.0;
  constexpr double alike = 0.5;
  if (first.verdict == Verdict::consistent || other.verdict != Verdict::missing_effect) return false;
  if (first.forms.size() != other.forms.size() || cannot_be_borne_out(other)) return false;
  if (std::max(first.unusual_start, other.unusual_start) > ordinary) return false;
  for (std::size_t i = 0; i < first.sizes.size(); ++i) {
    if (at_some_bearing(first.forms[i]) != at_some_bearing(other.forms[i])) return false;
    const double ratio = first.sizes[i] / other.sizes[i];
    if (!(ratio > alike && ratio < 1.0 / alike)) return false;
  }
  return true;
}

/// An event that the other recording cannot judge; of a slip it can (Diagnoser::slips_of_its_own).
bool cannot_be_judged(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.effects.begin(), diagnosis.effects.end(), [](const FoundEffect& effect) {
    return physics::happens_once(effect.id) && effect.id != "bracket_slip";
  });
}

/// Does the explanation remove more than half of what is wrong there without it, the noise aside?
bool helps_there(const ChannelReport& channel, const HeldOut& other) {
  const auto with = other.explained.find(channel.channel);
  const auto without = other.refitted.find(channel.channel);
  if (with == other.explained.end() || without == other.refitted.end()) return false;
  const auto beyond_noise = [&](double rms) { return std::max(0.0, rms * rms - channel.noise * channel.noise); };
  return beyond_noise(with->second) < 0.5 * beyond_noise(without->second);
}

/// An effect that the first recording leaves in doubt was asked about in the others, beside what it shows by itself.
/// What that hides of the effect's law the others may show: asked by themselves they need not be missed by as much.
bool decided_with_others(const Diagnosis& diagnosis) {
  return std::any_of(diagnosis.notes.begin(), diagnosis.notes.end(),
                     [](const std::string& note) { return note.starts_with("decided_with_others:"); });
}

/// Rows so far apart that what switched between them is missed in each recording in another way: a prediction that
/// fails shows nothing, and no effect that only the other recording shows is more than that.
bool rows_too_coarse(const Diagnosis& diagnosis) {
  return std::find(diagnosis.notes.begin(), diagnosis.notes.end(), "coarse_rows") != diagnosis.notes.end();
}

/// By itself: what only another recording shows (Diagnoser::judge) is told by a note.
bool shows_nothing(const Diagnosis& diagnosis) {
  return diagnosis.verdict == Verdict::consistent ||
         std::any_of(diagnosis.notes.begin(), diagnosis.notes.end(),
                     [](const std::string& note) { return note.starts_with("moved_elsewhere:"); });
}

/// The other recording is missed in the very channel that the effects explain, and in that alone: the description is of
/// this machine, but the explanation does not hold. Where everything is missed it is another machine's recording. That
/// it helps there saves it, unless that one shows by itself that nothing is missing: without it the fit is bent.
bool fails_where_it_explains(const Diagnosis& first, const HeldOut& other, bool nothing_is_missing_there) {
  if (first.verdict != Verdict::missing_effect || cannot_be_judged(first) || first.mismatch.channels.empty())
    return false;
  for (const ChannelReport& channel : first.channels) {
    const bool explained = channel.channel == first.mismatch.channels.front();
    const double by = missed_by(channel, other);
    // A slip bends the fit without it so much that anything helps.
    const bool helps = !nothing_is_missing_there && !happened_once(first) && helps_there(channel, other);
    if (explained ? by <= contradicted || helps : by >= in_order) return false;
  }
  return true;
}

/// Nothing seemed to be missing, but the other recording is missed by far in some displacement while everything else is
/// in order there: it is of this machine, and something moves the nose that the first recording could hide.
bool hides_a_movement(Diagnosis& first, const HeldOut& other) {
  constexpr double by_far = 10.0;
  if (first.verdict != Verdict::consistent) return false;
  const ChannelReport* moved = nullptr;
  for (const ChannelReport& channel : first.channels) {
    const double by = missed_by(channel, other);
    if (by > by_far && !channel.temperature) moved = &channel;
    if (by >= in_order && channel.temperature) return false;
  }
  if (moved == nullptr) return false;
  std::erase(first.mismatch.channels, moved->channel);
  first.mismatch.channels.insert(first.mismatch.channels.begin(), moved->channel);
  first.notes.push_back("moved_elsewhere:" + moved->channel);
  return true;
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
  if (first.wrong_set_up) return first;  // as wrong for the others: what they name stands in for it
  // A recording that shows by itself that something is missing may still be too poor to show what.
  const bool unexplained_alone = first.verdict == Verdict::unexplained && !first.refuted;
  // One that shows nothing says little where it hardly excites anything: nothing is missing if neither shows it.
  const bool alone_says_little = unexplained_alone || first.verdict == Verdict::consistent;
  if (first.verdict == Verdict::consistent && rows_too_coarse(first)) return first;
  std::size_t worst = 0;
  double missed = alone_says_little ? 0.0 : decided_with_others(first) ? in_order : contradicted;
  for (std::size_t i = 0; i < first.held_out.size(); ++i) {
    const double by = missed_by(first, first.held_out[i]);
    if (by <= missed) continue;
    missed = by;
    worst = i + 1;
  }
  if (worst == 0) return first;
  std::vector<recording::Recording> turned = recordings;
  std::swap(turned[0], turned[worst]);
  Diagnoser diagnoser(machine, turned, options, context);
  Result<Diagnosis> turned_round = diagnoser.run(Diagnoser::Of::what_is_named);
  if (!turned_round) {  // held out it did no harm: what is wrong with it does not spoil the first one's answer
    if (turned_round.error().code == ErrorCode::cancelled) return turned_round;
    return first;
  }
  Diagnosis other = std::move(*turned_round);
  other.seconds += first.seconds;
  const bool twice = found_twice(first, other);
  if (twice && first.verdict == Verdict::missing_effect) {
    first.seconds = other.seconds;
    return first;
  }
  // Predicted well, or likelier with what is uncertain of the prediction.
  const auto holds = [&] {
    return missed_by(other) < (alone_says_little ? in_order : contradicted) ||
           (alone_says_little && diagnoser.borne_out_elsewhere());
  };
  // What happened once in the other recording cannot be borne out by the first, and the same explanation in both, of
  // which one makes the other worse, is not saved by the turn.
  const bool borne_out = other.verdict == Verdict::missing_effect && !cannot_be_borne_out(other) &&
                         other.forms != first.forms && holds() &&
                         !(shows_nothing(first) && fails_where_it_explains(other, other.held_out[worst - 1], true));
  if (!twice && !borne_out) {
    const HeldOut& missed_one = first.held_out[worst - 1];
    if (fails_where_it_explains(first, missed_one, shows_nothing(other)) || hides_a_movement(first, missed_one)) {
      first.verdict = Verdict::unexplained;
      first.sentences = explain_unexplained(first);
      first.sentences.insert(first.sentences.begin(), explain_verdict(first));
    }
    first.seconds = other.seconds;
    return first;
  }
  other.notes.push_back("fitted_instead:" + turned[0].name);
  return other;
}

}  // namespace zerodrift::diagnosis
