// What the recordings that were not fitted say of the answer: how well they are predicted, whether they refute it, and
// whether they are of this machine at all.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/diagnosis/confidence.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/elsewhere.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/refined.h"
#include "core/physics/inputs.h"

namespace zerodrift::diagnosis {

using physics::Machine;
using recording::Recording;

/// Measured - predicted where a sample is there and no spike.
static std::vector<double> differences(const Recording& recording, const std::string& name,
                                       const std::vector<double>& predicted) {
  std::vector<double> list;
  const recording::Channel* seen = recording.find(name);
  if (seen == nullptr || seen->values.size() != predicted.size()) return list;
  const std::vector<bool> spike = physics::spikes(seen->values, physics::noise_width(seen->values, 0.01));
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    if (std::isfinite(seen->values[k]) && !spike[k]) list.push_back(seen->values[k] - predicted[k]);
  }
  return list;
}

static double rms_of(const std::vector<double>& differences) {
  double sum = 0.0;
  for (const double d : differences) sum += d * d;
  return differences.empty() ? std::nan("") : std::sqrt(sum / static_cast<double>(differences.size()));
}

/// The least that one step at some moment leaves.
static double rms_beside_a_step(const std::vector<double>& differences) {
  double sum = 0.0, squares = 0.0, removed = 0.0, count = 0.0;
  for (const double d : differences) squares += d * d;
  for (auto d = differences.rbegin(); d != differences.rend(); ++d) {
    sum += *d;
    count += 1.0;
    removed = std::max(removed, sum * sum / count);
  }
  return count > 0.0 ? std::sqrt(std::max(0.0, squares - removed) / count) : std::nan("");
}

double rms_between(const Recording& recording, const std::string& name, const std::vector<double>& predicted) {
  return rms_of(differences(recording, name, predicted));
}

/// How the logger's samples and the switching times lie to each other: the same in its next recording.
static double hold_of(const Model& model) {
  return model.values()[model.network().hold_parameter];
}

/// Mean squares of what a machine leaves of the other recordings, in widths of noise.
double Diagnoser::left_elsewhere(const Machine& machine) const {
  const double hold = hold_of(*m_selection.best);
  double left = 0.0;
  for (std::size_t i = 1; i < m_recordings.size(); ++i) {
    const physics::Prediction prediction = predict_other(machine, m_recordings[i], hold);
    for (const MeasuredChannel& channel : m_default_data->channels) {
      const auto seen = std::find_if(prediction.channels.begin(), prediction.channels.end(),
                                     [&](const auto& one) { return one.channel == channel.name; });
      if (channel.samples == 0 || seen == prediction.channels.end()) continue;
      const double rms = rms_between(m_recordings[i], channel.name, seen->values);
      if (std::isfinite(rms)) left += std::pow(rms / channel.white, 2);
    }
  }
  return left;
}

/// Oil and preload change with temperature: counted from one that stays, or from where each run starts? A recording
/// cannot tell, for it starts but once. Where the description says nothing the others are asked; a law that stays is
/// the rule.
bool Diagnoser::counts_from_each_start(const Machine& best) const {
  constexpr double clearly = 1.05;
  const bool told = m_machine.reference_temperature_C.has_value() || m_recordings.size() < 2;
  const bool by_temperature = std::any_of(best.effects.begin(), best.effects.end(), [](const auto& spec) {
    return spec.id == "bearing_preload" || spec.id == "bearing_viscosity" || spec.id == "conductivity_temperature";
  });
  if (told || !by_temperature) return false;
  Machine anew = best;
  anew.reference_temperature_C.reset();
  return clearly * left_elsewhere(anew) < left_elsewhere(best);
}

/// How the other recordings are predicted as described, re-fitted and with the effects found.
void Diagnoser::held_out() {
  const Machine base = refined_machine(*m_selection.base);
  Machine best = refined_machine(*m_selection.best);
  m_from_each_start = m_selection.best != m_selection.base && counts_from_each_start(best);
  if (m_from_each_start) best.reference_temperature_C.reset();
  for (std::size_t i = 1; i < m_recordings.size(); ++i) {
    const Recording& other = m_recordings[i];
    HeldOut result;
    result.recording = other.name;
    const auto put = [&](const Machine& machine, double hold, std::map<std::string, double>& target) {
      for (const auto& channel : predict_other(machine, other, hold).channels) {
        const double rms = rms_between(other, channel.channel, channel.values);
        if (std::isfinite(rms)) target[channel.channel] = rms;
      }
    };
    put(m_machine, 0.0, result.nominal);
    put(base, hold_of(*m_selection.base), result.refitted);
    result.explained = result.refitted;
    if (m_selection.best != m_selection.base) {
      put(best, hold_of(*m_selection.best), result.explained);
      slips_of_its_own(best, other, result);
    }
    m_out.held_out.push_back(std::move(result));
  }
}

/// A bracket that slipped in one recording stays where it is in the next, or slips there too, at a moment of its own.
/// What goes to and fro there did not slip.
void Diagnoser::slips_of_its_own(const Machine& best, const Recording& other, HeldOut& result) const {
  Machine without = best;
  std::erase_if(without.effects, [](const auto& spec) { return spec.id == "bracket_slip"; });
  if (without.effects.size() == best.effects.size()) return;
  for (const auto& channel : predict_other(without, other, hold_of(*m_selection.best)).channels) {
    const bool slipped = std::any_of(best.effects.begin(), best.effects.end(), [&](const auto& spec) {
      return spec.id == "bracket_slip" && spec.word_or("channel", "") == channel.channel;
    });
    auto known = result.explained.find(channel.channel);
    if (!slipped || known == result.explained.end()) continue;
    const auto left = differences(other, channel.channel, channel.values);
    known->second = std::min({known->second, rms_of(left), rms_beside_a_step(left)});
  }
}

/// An explanation that makes another recording of the machine worse than none does is not one, unless that recording is
/// likelier with it all the same. What happened once - a slip, an open door - need not happen in the other.
bool Diagnoser::refuted() const {
  for (const std::size_t index : m_selection.effects()) {
    if (physics::happens_once(m_selection.best->machine().effects[index].id)) return false;
  }
  constexpr double clearly = 1.5;
  for (const HeldOut& other : m_out.held_out) {
    double without = 0.0, with = 0.0;
    for (const MeasuredChannel& channel : m_default_data->channels) {
      const auto before = other.refitted.find(channel.name);
      const auto after = other.explained.find(channel.name);
      if (channel.samples == 0 || before == other.refitted.end() || after == other.explained.end()) continue;
      without += std::pow(before->second / channel.white, 2);
      with += std::pow(after->second / channel.white, 2);
    }
    if (with > clearly * without) return !borne_out_elsewhere();
  }
  return false;
}

bool Diagnoser::borne_out_elsewhere() const {
  // What stands for many parts as one lump each never fits.
  const double left_at_most = m_lumps_only ? std::numeric_limits<double>::infinity() : least_evident;
  return borne_out(*m_selection.best, *m_selection.base, m_limits.others, left_at_most);
}

/// The channel that an other recording misses most in what the fitted one leaves of it, where that is far more than
/// noise and than what it leaves here; null: none.
const ChannelReport* Diagnoser::missed_by_far(const HeldOut& other) const {
  constexpr double far = 3.0;  // of what is left here, and of noise
  const ChannelReport* worst = nullptr;
  double largest = far;
  for (const ChannelReport& channel : m_out.channels) {
    const auto rms = other.explained.find(channel.channel);
    if (rms == other.explained.end()) continue;
    const double times = rms->second / std::max({channel.rms_explained, channel.noise, 1e-9});
    if (times > largest) largest = times, worst = &channel;
  }
  return worst;
}

/// A recording that is predicted badly may only show what the fitted one left uncertain. One that does not fit even
/// with all of that free is of another machine, or of this one after something was changed.
void Diagnoser::another_machine() {
  if (m_out.verdict == Verdict::unexplained) return;  // what is missing here is missing there
  // What switched between two rows that are so far apart is missed in each recording in another way.
  constexpr double too_coarse_s = 300.0;
  if (seconds_between_rows() >= too_coarse_s && !nothing_drives()) return;
  const bool missed = std::any_of(m_out.held_out.begin(), m_out.held_out.end(),
                                  [&](const HeldOut& other) { return missed_by_far(other) != nullptr; });
  if (!missed) return;
  for (std::size_t i = 0; i < m_out.held_out.size() && i < m_other_sets.size(); ++i) {
    const HeldOut& other = m_out.held_out[i];
    const ChannelReport* worst = missed_by_far(other);
    if (worst == nullptr || fits_elsewhere(*m_used, m_other_sets[i])) continue;
    m_out.notes.push_back("held_out_differs:" + other.recording + ":" + worst->channel);
    m_out.sentences.push_back(
        explain_note("held_out_differs", {{"recording", other.recording},
                                          {"channel", worst->channel},
                                          {"after", fmt::format("{:.2g}", other.explained.at(worst->channel))},
                                          {"here", fmt::format("{:.2g}", worst->rms_explained)},
                                          {"unit", worst->temperature ? "K" : "µm"}}));
  }
}

bool Diagnoser::of_another_machine(const HeldOut& other) const {
  return std::any_of(m_out.notes.begin(), m_out.notes.end(), [&](const std::string& note) {
    return note.starts_with("held_out_differs:" + other.recording + ":");
  });
}

/// Whether a held-out recording is met worse with what is named than without it, and where most.
void Diagnoser::worse_elsewhere() {
  constexpr double clearly = 1.05;  // of all squares, in widths of noise
  constexpr double in_one = 1.5;    // of one channel's rms
  constexpr double noticed = 2.0;   // widths of noise
  constexpr double far = 1.5;       // of all squares
  if (m_out.effects.empty()) return;
  const bool once = std::any_of(m_out.effects.begin(), m_out.effects.end(),
                                [](const FoundEffect& found) { return physics::happens_once(found.id); });
  const bool lasts = std::any_of(m_out.effects.begin(), m_out.effects.end(),
                                 [](const FoundEffect& found) { return !physics::happens_once(found.id); });
  for (const HeldOut& other : m_out.held_out) {
    if (of_another_machine(other)) continue;
    double without = 0.0, with = 0.0, largest = 0.0;
    const ChannelReport* worst = nullptr;
    bool one_is_worse = false;
    for (const ChannelReport& channel : m_out.channels) {
      const auto before = other.refitted.find(channel.channel);
      const auto after = other.explained.find(channel.channel);
      if (before == other.refitted.end() || after == other.explained.end()) continue;
      const double noise = std::max(channel.noise, 1e-9);
      without += std::pow(before->second / noise, 2);
      with += std::pow(after->second / noise, 2);
      const double more = (after->second - before->second) / noise;
      one_is_worse |= after->second > in_one * before->second && after->second > noticed * noise;
      if (more <= largest) continue;
      largest = more;
      worst = &channel;
    }
    if (worst == nullptr || (with <= clearly * without && !one_is_worse)) continue;
    // Other runs refute nothing of lumps (borne_out_elsewhere), nor of what happened once (refuted): doubt is all that
    // they leave, of what lasts beside that.
    if ((m_lumps_only && !once && with > clearly * without) || (once && lasts && with > far * without)) {
      for (FoundEffect& found : m_out.effects) found.confidence *= doubt::worse_elsewhere;
    }
    m_out.notes.push_back("held_out_worse:" + other.recording + ":" + worst->channel);
    m_out.sentences.push_back(explain_note(once ? "held_out_worse_once" : "held_out_worse",
                                           {{"recording", other.recording},
                                            {"channel", worst->channel},
                                            {"before", fmt::format("{:.2g}", other.refitted.at(worst->channel))},
                                            {"after", fmt::format("{:.2g}", other.explained.at(worst->channel))},
                                            {"unit", worst->temperature ? "K" : "µm"}}));
  }
}

}  // namespace zerodrift::diagnosis
