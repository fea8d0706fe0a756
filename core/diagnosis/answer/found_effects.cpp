#include "core/diagnosis/answer/found_effects.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/answer/fitted_description.h"
#include "core/diagnosis/answer/heat_of_effect.h"

namespace zerodrift::diagnosis::answer {

using inference::Fit;
using inference::HeldEffect;

namespace {

/// Numbers of an effect that are at the limit of what they can be.
std::vector<std::string> bounds_of(const PosteriorSummary& summary, std::size_t effect) {
  constexpr double at_it = 1e-3;  // standard deviations
  std::vector<std::string> keys;
  const inference::JointModel& model = summary.best.model();
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const auto at = static_cast<Eigen::Index>(i);
    const double z = summary.best.z()[at];
    if (model.unknown(i).effect != static_cast<int>(effect)) continue;
    if (z < model.low()[at] + at_it || z > model.high()[at] - at_it) keys.push_back(model.unknown(i).parameter.key);
  }
  return keys;
}

bool is(const HeldEffect& one, const HeldEffect& other) {
  return !(name_of(one) < name_of(other)) && !(name_of(other) < name_of(one));
}

/// Where it is by the best explanation, and how well that is known by all that have it.
void place(const PosteriorSummary& summary, std::size_t effect, FoundEffect& found) {
  // A joint is broad and conducts unevenly; of a source a tenth of a cell of the simulation.
  constexpr double least_of_a_joint = 0.006, least_of_a_source = 0.0025;  // of the length
  constexpr double widest_point_mm = 6.0;                                 // what is known worse is a stretch
  const physics::Component* part = summary.described.find(found.component);
  const double length_mm = part == nullptr ? 0.0 : part->length_mm;
  const double at_mm = found.parameters.at("position_mm");
  const bool broad = found.parameters.count("half_width_mm") != 0;
  const double least = broad ? least_of_a_joint : least_of_a_source;
  double squares = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < summary.probability.size(); ++i) {
    const Fit& fit = *summary.posterior.explanations[i].fit;
    const auto& held = fit.model().hypothesis().effects;
    for (std::size_t e = 0; e < held.size(); ++e) {
      if (!is(held[e], summary.best.model().hypothesis().effects[effect])) continue;
      std::map<std::string, double> sigma;
      const physics::EffectSpec spec = fitted_effect(fit, e, &sigma);
      if (spec.numbers.count("position_mm") == 0) continue;
      mass += summary.probability[i];
      squares += summary.probability[i] *
                 (std::pow(spec.numbers.at("position_mm") - at_mm, 2) + std::pow(sigma["position_mm"], 2));
    }
  }
  const double sigma_mm = std::hypot(std::sqrt(mass > 0.0 ? squares / mass : 0.0), least * length_mm);
  found.position_mm = at_mm;
  found.position_sigma_mm = found.sigma["position_mm"] = sigma_mm;
  if (sigma_mm > widest_point_mm)
    found.between_mm = {std::max(0.0, at_mm - 2.0 * sigma_mm), std::min(length_mm, at_mm + 2.0 * sigma_mm)};
}

/// Measured less fitted in the first recording that has the series, rms.
double off(const Fit& fit, std::size_t series) {
  const inference::Evidence& evidence = fit.model().evidence();
  for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
    const inference::MeasuredSeries& measured = evidence.runs()[r].series[series];
    double sum = 0.0;
    for (std::size_t k = 0; k < measured.values.size(); ++k) {
      if (measured.present[k]) sum += std::pow(measured.values[k] - fit.predicted()[r][series][k], 2);
    }
    if (measured.samples > 0) return std::sqrt(sum / measured.samples);
  }
  return 0.0;
}

/// The channel that shows an effect best: its own, or the one that it changes most.
ShownBy shown_by(const PosteriorSummary& summary, const std::vector<ChannelReport>& channels, FoundEffect& found,
                 const Fit& less) {
  const std::vector<std::size_t> series = summary.reported();
  ShownBy shown;
  double largest = 0.0;
  for (std::size_t i = 0; i < channels.size(); ++i) {
    const ChannelReport& channel = channels[i];
    found.contribution[channel.channel] = summary.taken(less, series[i]);
    const double size =
        found.channel == channel.channel ? 1e300 : found.contribution[channel.channel] / summary.allowed(series[i]);
    if (size < largest && !shown.channel.empty()) continue;
    largest = size;
    // One effect alone: what the table of the channels calls re-fitted is the simulation without it.
    const bool alone = summary.best.model().hypothesis().effects.size() == 1;
    shown = {channel.channel, alone ? channel.rms_refitted : off(less, series[i]),
             alone ? channel.rms_explained : off(summary.best, series[i]), channel.noise};
  }
  return shown;
}

}  // namespace

std::vector<FoundEffect> found_effects(const PosteriorSummary& summary, const std::vector<ChannelReport>& channels) {
  std::vector<FoundEffect> effects;
  const auto& held = summary.best.model().hypothesis().effects;
  for (std::size_t e = 0; e < held.size(); ++e) {
    const Name name = name_of(held[e]);
    FoundEffect found;
    const physics::EffectSpec spec = fitted_effect(summary.best, e, &found.sigma);
    found.id = spec.id;
    found.component = spec.word_or("component", "");
    found.channel = spec.word_or("channel", "");
    found.parameters = spec.numbers;
    found.words = spec.words;
    found.intervals_s = spec.intervals_s;
    if (held[e].run >= 0) found.recording = summary.recordings[static_cast<std::size_t>(held[e].run)].name;
    found.at_rpm = speeds_of_figures(spec.numbers, spec.words, summary.best.model().network(0).full_speed_rpm);
    found.bounds_reached = bounds_of(summary, e);
    if (spec.numbers.count("position_mm") != 0) place(summary, e, found);
    if (summary.options.details) found.heat = heat_of_effect(summary.best, e);
    found.confidence = summary.mass_of(name);
    found.log_evidence_gain = summary.gain_of(name);
    found.explanation = explain_effect(found, summary.recordings.front().time_s.back(),
                                       shown_by(summary, channels, found, summary.without({name})));
    effects.push_back(std::move(found));
  }
  std::stable_sort(effects.begin(), effects.end(),
                   [](const auto& a, const auto& b) { return a.log_evidence_gain > b.log_evidence_gain; });
  return effects;
}

}  // namespace zerodrift::diagnosis::answer
