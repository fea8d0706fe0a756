#include "core/diagnosis/answer/assess.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/diagnosis/answer/detectable.h"
#include "core/diagnosis/answer/experiment.h"
#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/answer/fitted_description.h"
#include "core/diagnosis/answer/heat_history.h"
#include "core/diagnosis/answer/heat_of_effect.h"
#include "core/diagnosis/answer/mistakes.h"
#include "core/diagnosis/answer/regime.h"
#include "core/diagnosis/input/channels.h"
#include "core/physics/initial_state.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis::answer {
namespace {

using inference::Evidence;
using inference::Fit;
using inference::HeldEffect;
using search::Explanation;
using search::Posterior;

/// What is named: an effect on a part or a channel, whatever its place, law or figures.
struct Name {
  std::string id, component, channel;
  bool operator<(const Name& other) const {
    return std::tie(id, component, channel) < std::tie(other.id, other.component, other.channel);
  }
};

Name name_of(const HeldEffect& effect) {
  return {effect.spec.id, effect.spec.word_or("component", ""), effect.spec.word_or("channel", "")};
}

std::set<Name> names_of(const Explanation& explanation) {
  std::set<Name> names;
  for (const HeldEffect& effect : explanation.fit->model().hypothesis().effects) names.insert(name_of(effect));
  return names;
}

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

/// Root mean square of what a fit leaves of a series beyond its noise, over all runs; with what is new in each
/// recording fitted.
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

/// Fitted as if it left no more than such descriptions usually do: where the discrepancy may be any size, a fit that is
/// far off has no reason to come nearer.
Fit at_usual_sizes(const Fit& start) {
  Fit fit(start);
  fit.set_sizes(fit.model().evidence().usual_sizes());
  fit.fit({fit.model().evidence().settings().iterations, true});
  return fit;
}

class Assessment {
 public:
  Assessment(const Posterior& posterior, const physics::Machine& described, const CheckedRuns& runs,
             const DiagnoseOptions& options)
      : m_posterior(posterior),
        m_evidence(*posterior.evidence),
        m_settings(m_evidence.settings()),
        m_best(*posterior.explanations.front().fit),
        m_base(at_usual_sizes(*posterior.described_straight)),
        m_described(described),
        m_runs(runs),
        m_recordings(runs.recordings),
        m_options(options),
        m_probability(probabilities(posterior, m_settings.tempering)) {}

  Diagnosis made() {
    m_out.refined = fitted_description(m_best);
    m_out.findings = m_runs.findings;
    channels();
    effects();
    rivals();
    tried();
    verdict();
    mismatch();
    held_out();
    tell_mistakes(m_posterior, m_probability, m_out);
    if (m_out.verdict == Verdict::consistent) m_out.mismatch = {};
    if (m_options.details) details();
    notes();
    sentences();
    return std::move(m_out);
  }

 private:
  double mass_of(const Name& name) const {
    double mass = 0.0;
    for (std::size_t i = 0; i < m_probability.size(); ++i) {
      if (names_of(m_posterior.explanations[i]).count(name) != 0) mass += m_probability[i];
    }
    return mass;
  }

  /// What a good description leaves of a channel: settings.adequate_*.
  double allowed(std::size_t series) const {
    const bool coarse = m_evidence.is_coarse(series);
    const double slow = m_evidence.runs().front().series[series].slow;
    return std::hypot(
        (coarse ? m_settings.adequate_coarse_size : m_settings.adequate_size) * slow,
        (coarse ? m_settings.adequate_coarse_share : m_settings.adequate_share) * m_evidence.range(series));
  }

  /// With its inputs at the times at which the best explanation has them.
  recording::Recording driven(const recording::Recording& run) const {
    return set_right(run, m_best.model().hypothesis().errors);
  }

  /// Where a displacement counts from is new in each recording: the simulation is shifted to the zero of the fit.
  recording::Recording at_its_zero(recording::Recording simulation, const Fit& fit) const {
    const inference::Run& run = m_evidence.runs().front();
    for (std::size_t c = 0; c < run.series.size(); ++c) {
      const inference::MeasuredSeries& series = run.series[c];
      recording::Channel* channel = simulation.find(series.channel);
      if (series.temperature || series.samples == 0 || channel == nullptr) continue;
      double shift = 0.0;
      for (std::size_t k = 0; k < run.rows(); ++k) {
        if (series.present[k])
          shift += fit.predicted().front()[c][k] - recording::value_at(simulation, *channel, run.recording.time_s[k]);
      }
      shift /= series.samples;
      for (double& value : channel->values) value += shift;
    }
    return simulation;
  }

  void channels() {
    const recording::Recording& first = m_recordings.front();
    const auto simulated = [&](const physics::Machine& machine, const recording::Recording& run) {
      auto result = physics::simulate(machine, run);
      return result ? result->prediction : recording::Recording{};
    };
    const recording::Recording nominal = simulated(m_described, first);
    const recording::Recording explained = at_its_zero(simulated(m_out.refined, driven(first)), m_best);
    const recording::Recording refitted = at_its_zero(simulated(fitted_description(m_base), first), m_base);
    m_out.time_s = first.time_s;
    const auto rms = [&](const recording::Recording& simulation, const std::string& channel) {
      for (const auto& one : physics::compare(simulation, first)) {
        if (one.channel == channel) return one.rms;
      }
      return 0.0;
    };
    const auto values = [&](const recording::Recording& simulation, const std::string& channel) {
      const recording::Channel* found = simulation.find(channel);
      return found == nullptr ? std::vector<double>(first.rows(), std::nan("")) : found->values;
    };
    for (std::size_t c = 0; c < m_evidence.series(); ++c) {
      if (m_evidence.samples(c) == 0) continue;
      const inference::MeasuredSeries& series = m_evidence.runs().front().series[c];
      ChannelReport report;
      report.channel = series.channel;
      report.temperature = series.temperature;
      const recording::Channel* measured = first.find(series.channel);
      if (measured == nullptr) continue;
      report.measured = measured->values;
      report.nominal = values(nominal, series.channel);
      report.refitted = values(refitted, series.channel);
      report.explained = values(explained, series.channel);
      report.rms_nominal = rms(nominal, series.channel);
      report.rms_refitted = rms(refitted, series.channel);
      report.rms_explained = rms(explained, series.channel);
      report.noise = series.white;
      const double limit = allowed(c);
      const double before = leftover(m_base, c), after = leftover(m_best, c);
      report.excess_refitted = before / limit;
      report.excess_explained = after / limit;
      constexpr double material = 0.5;  // of what was left, that an explanation has to take
      const bool changed =
          !m_best.model().hypothesis().effects.empty() && after < material * before && before > series.slow;
      report.verdict = report.excess_explained > 1.0 ? ChannelVerdict::unexplained
                       : changed                     ? ChannelVerdict::explained
                                                     : ChannelVerdict::consistent;
      m_series.push_back(c);
      m_out.channels.push_back(std::move(report));
    }
    for (const ChannelReport& one : m_out.channels) {
      m_out.excess_before = std::max(m_out.excess_before, one.excess_refitted);
      m_out.excess_after = std::max(m_out.excess_after, one.excess_explained);
    }
  }

  void effects() {
    const auto& held = m_best.model().hypothesis().effects;
    const std::set<Name> left_out = of_details();
    for (std::size_t e = 0; e < held.size(); ++e) {
      const double mass = mass_of(name_of(held[e]));
      if (mass < m_settings.named_from) continue;
      const Name name = name_of(held[e]);
      if (left_out.count(name) != 0) continue;
      FoundEffect found;
      const physics::EffectSpec spec = fitted_effect(m_best, e, &found.sigma);
      found.id = spec.id;
      found.component = spec.word_or("component", "");
      found.channel = spec.word_or("channel", "");
      found.parameters = spec.numbers;
      found.words = spec.words;
      found.intervals_s = spec.intervals_s;
      if (held[e].run >= 0) found.recording = m_recordings[static_cast<std::size_t>(held[e].run)].name;
      found.at_rpm = speeds_of_figures(spec.numbers, spec.words, m_best.model().network(0).full_speed_rpm);
      found.bounds_reached = bounds_of(e);
      if (spec.numbers.count("position_mm") != 0) place(e, found);
      if (m_options.details) found.heat = heat_of_effect(m_best, e);
      found.confidence = mass;
      found.log_evidence_gain = gain_of(name);
      found.explanation = explain_effect(found, m_out.time_s.back(), shown_by(found, without({name})));
      m_out.effects.push_back(std::move(found));
    }
    std::stable_sort(m_out.effects.begin(), m_out.effects.end(),
                     [](const auto& a, const auto& b) { return a.log_evidence_gain > b.log_evidence_gain; });
  }

  /// Numbers of an effect that are at the limit of what they can be.
  std::vector<std::string> bounds_of(std::size_t effect) const {
    constexpr double at_it = 1e-3;  // standard deviations
    std::vector<std::string> keys;
    const inference::JointModel& model = m_best.model();
    for (std::size_t i = 0; i < model.unknowns(); ++i) {
      const auto at = static_cast<Eigen::Index>(i);
      const double z = m_best.z()[at];
      if (model.unknown(i).effect != static_cast<int>(effect)) continue;
      if (z < model.low()[at] + at_it || z > model.high()[at] - at_it) keys.push_back(model.unknown(i).parameter.key);
    }
    return keys;
  }

  /// Where it is by the best explanation, and how well that is known by all that have it.
  void place(std::size_t effect, FoundEffect& found) const {
    // A joint is broad and conducts unevenly; of a source a tenth of a cell of the simulation.
    constexpr double least_of_a_joint = 0.006, least_of_a_source = 0.0025;  // of the length
    constexpr double widest_point_mm = 6.0;                                 // what is known worse is a stretch
    const physics::Component* part = m_described.find(found.component);
    const double length_mm = part == nullptr ? 0.0 : part->length_mm;
    const double at_mm = found.parameters.at("position_mm");
    const double least = found.id == "contact_resistance" ? least_of_a_joint : least_of_a_source;
    double squares = 0.0, mass = 0.0;
    for (std::size_t i = 0; i < m_probability.size(); ++i) {
      const Fit& fit = *m_posterior.explanations[i].fit;
      const auto& held = fit.model().hypothesis().effects;
      for (std::size_t e = 0; e < held.size(); ++e) {
        const bool same = &fit == &m_best ? e == effect : is(held[e], m_best.model().hypothesis().effects[effect]);
        if (!same) continue;
        std::map<std::string, double> sigma;
        const physics::EffectSpec spec = fitted_effect(fit, e, &sigma);
        if (spec.numbers.count("position_mm") == 0) continue;
        mass += m_probability[i];
        squares += m_probability[i] *
                   (std::pow(spec.numbers.at("position_mm") - at_mm, 2) + std::pow(sigma["position_mm"], 2));
      }
    }
    const double sigma_mm = std::hypot(std::sqrt(mass > 0.0 ? squares / mass : 0.0), least * length_mm);
    found.position_mm = at_mm;
    found.position_sigma_mm = found.sigma["position_mm"] = sigma_mm;
    if (sigma_mm > widest_point_mm)
      found.between_mm = {std::max(0.0, at_mm - 2.0 * sigma_mm), std::min(length_mm, at_mm + 2.0 * sigma_mm)};
  }

  static bool is(const HeldEffect& one, const HeldEffect& other) {
    return !(name_of(one) < name_of(other)) && !(name_of(other) < name_of(one));
  }

  /// Effects of the best explanation that only take details which a better form of something else would take as well:
  /// left out one after the other, the least supported first, as long as no channel is left with more.
  std::set<Name> of_details() const {
    std::vector<Name> order;
    for (const Name& name : names_of(m_posterior.explanations.front())) order.push_back(name);
    std::stable_sort(order.begin(), order.end(), [&](const Name& a, const Name& b) { return gain_of(a) < gain_of(b); });
    std::set<Name> out;
    for (const Name& name : order) {
      out.insert(name);
      if (is_material(without(out))) out.erase(name);
    }
    return out;
  }

  /// The best explanation without these effects, fitted anew.
  Fit without(const std::set<Name>& names) const {
    inference::Hypothesis hypothesis = m_best.model().hypothesis();
    std::erase_if(hypothesis.effects, [&](const HeldEffect& held) { return names.count(name_of(held)) != 0; });
    Fit fit(std::make_shared<inference::JointModel>(std::move(hypothesis), m_best.model().shared_evidence()),
            m_best.sizes());
    fit.start_from(m_best, false);
    fit.fit({m_settings.iterations, true});
    return fit;
  }

  /// Does it leave more of some channel?
  bool is_material(const Fit& less) const {
    for (std::size_t c = 0; c < m_evidence.series(); ++c) {
      if (m_evidence.samples(c) > 0 && taken(less, c) > m_settings.material_share * leftover(m_base, c)) return true;
    }
    return false;
  }

  /// What the best explanation takes of a series beyond a lesser one, rms.
  double taken(const Fit& less, std::size_t series) const {
    const double before = leftover(less, series), after = leftover(m_best, series);
    return std::sqrt(std::max(0.0, before * before - after * after));
  }

  /// The channel that shows an effect best: its own, or the one that it changes most.
  ShownBy shown_by(FoundEffect& found, const Fit& less) const {
    ShownBy shown;
    double largest = 0.0;
    for (std::size_t i = 0; i < m_out.channels.size(); ++i) {
      const ChannelReport& channel = m_out.channels[i];
      found.contribution[channel.channel] = taken(less, m_series[i]);
      const double size =
          found.channel == channel.channel ? 1e300 : found.contribution[channel.channel] / allowed(m_series[i]);
      if (size < largest && !shown.channel.empty()) continue;
      largest = size;
      // One effect alone: what the table of the channels calls re-fitted is the simulation without it.
      const bool alone = m_best.model().hypothesis().effects.size() == 1;
      shown = {channel.channel, alone ? channel.rms_refitted : off(less, m_series[i]),
               alone ? channel.rms_explained : off(m_best, m_series[i]), channel.noise};
    }
    return shown;
  }

  /// Measured less fitted in the first recording that has the series, rms.
  double off(const Fit& fit, std::size_t series) const {
    for (std::size_t r = 0; r < m_evidence.runs().size(); ++r) {
      const inference::MeasuredSeries& measured = m_evidence.runs()[r].series[series];
      double sum = 0.0;
      for (std::size_t k = 0; k < measured.values.size(); ++k) {
        if (measured.present[k]) sum += std::pow(measured.values[k] - fit.predicted()[r][series][k], 2);
      }
      if (measured.samples > 0) return std::sqrt(sum / measured.samples);
    }
    return 0.0;
  }

  /// Log odds that the best loses without this effect: against the best explanation that has it not.
  double gain_of(const Name& name) const {
    for (const Explanation& one : m_posterior.explanations) {
      if (names_of(one).count(name) == 0) return m_posterior.explanations.front().log_posterior - one.log_posterior;
    }
    return m_settings.margin;
  }

  void rivals() {
    std::set<Name> named;
    for (const HeldEffect& effect : m_best.model().hypothesis().effects) {
      if (mass_of(name_of(effect)) >= m_settings.named_from) named.insert(name_of(effect));
    }
    std::set<std::string> ids;
    for (const Explanation& one : m_posterior.explanations) {
      for (const HeldEffect& effect : one.fit->model().hypothesis().effects) {
        const Name name = name_of(effect);
        if (named.count(name) != 0 || mass_of(name) < m_settings.rival_from || !ids.insert(name.id).second) continue;
        Rival rival;
        rival.id = name.id;
        rival.component = name.component;
        rival.channel = name.channel;
        rival.behind = m_posterior.explanations.front().log_posterior - one.log_posterior;
        rival.why = explain_rival(rival);
        m_out.ambiguous_with.push_back(std::move(rival));
      }
    }
  }

  void tried() {
    for (std::size_t i = 0; i < m_probability.size(); ++i) {
      const Explanation& one = m_posterior.explanations[i];
      Tried tried;
      for (const HeldEffect& held : one.fit->model().hypothesis().effects) tried.effects.push_back(held.spec.id);
      for (const DescriptionError& error : one.fit->model().hypothesis().errors)
        tried.mistakes.emplace_back(diagnosis::name_of(code_of(error)));
      std::sort(tried.effects.begin(), tried.effects.end());
      tried.probability = m_probability[i];
      tried.behind = m_posterior.explanations.front().log_posterior - one.log_posterior;
      m_out.tried.push_back(std::move(tried));
    }
  }

  void verdict() {
    const auto worst = std::max_element(m_out.channels.begin(), m_out.channels.end(), [](const auto& a, const auto& b) {
      return a.excess_refitted < b.excess_refitted;
    });
    const bool any = std::any_of(m_out.channels.begin(), m_out.channels.end(),
                                 [](const auto& one) { return one.verdict == ChannelVerdict::unexplained; });
    if (m_out.effects.empty()) {
      // Something is missing, and no one explanation of it is likely enough.
      const bool missing = m_probability[m_posterior.described] < 1.0 - m_settings.named_from;
      m_out.verdict = any || missing ? Verdict::unexplained : Verdict::consistent;
      return;
    }
    // What is named carries the largest mismatch, or it does not explain the recording.
    const bool carried = worst == m_out.channels.end() || worst->verdict != ChannelVerdict::unexplained ||
                         worst->excess_explained < 0.5 * worst->excess_refitted;
    m_out.verdict = carried ? Verdict::missing_effect : Verdict::unexplained;
  }

  void mismatch() {
    std::vector<const ChannelReport*> order;
    for (const ChannelReport& one : m_out.channels) order.push_back(&one);
    std::stable_sort(order.begin(), order.end(),
                     [](auto* a, auto* b) { return a->excess_refitted > b->excess_refitted; });
    for (const ChannelReport* one : order) {
      if (one->excess_refitted > 1.0 || m_out.mismatch.channels.empty())
        m_out.mismatch.channels.push_back(one->channel);
    }
    for (std::size_t i = 0; i < m_out.channels.size(); ++i) {
      if (m_out.channels[i].verdict == ChannelVerdict::unexplained) m_out.channels[i].time_s = off_in(i);
    }
    if (!m_options.details || order.empty()) return;
    const Fit& straight = *m_posterior.described_straight;
    const std::vector<HeatHistory> histories = heat_histories(straight, 0);
    const HeatHistory* best = nullptr;
    for (const HeatHistory& one : histories) {
      if (best == nullptr || one.best_log_evidence() > best->best_log_evidence()) best = &one;
    }
    if (best == nullptr) return;
    Mismatch& m = m_out.mismatch;
    m.component = best->component;
    const std::vector<double>& watts = best->watts[best->best];
    m.missing_heat_W = watts_while_acting(watts);
    m.regime = regime_of({best->time_s, watts}, m_evidence.runs().front().recording);
    m.time_s = stretches(best->time_s, watts);
    if (best->position_mm.size() > 1) {
      m.scan_position_mm = best->position_mm;
      m.scan_evidence = best->log_evidence;
      m.best_position_mm = best->position_mm[best->best];
      double from = m.best_position_mm, to = from;
      for (std::size_t i = 0; i < best->position_mm.size(); ++i) {
        if (best->log_evidence[i] < best->best_log_evidence() - m_settings.decisive) continue;
        from = std::min(from, best->position_mm[i]);
        to = std::max(to, best->position_mm[i]);
      }
      m.position_mm = {from, to};
      m_out.heat = HeatMap{best->component, best->position_mm, best->time_s, best->watts};
    }
    for (ChannelReport& channel : m_out.channels) {
      const physics::Sensor* sensor = m_described.sensor(channel.channel);
      for (const HeatHistory& one : histories) {
        if (sensor == nullptr || sensor->component != one.component) continue;
        channel.missing_heat_W = watts_while_acting(one.watts[one.best]);
        if (channel.verdict == ChannelVerdict::explained) channel.time_s = stretches(one.time_s, one.watts[one.best]);
      }
    }
  }

  /// When the best explanation misses a channel most: by means over a twenty-fourth of the recording.
  std::vector<std::pair<double, double>> off_in(std::size_t channel) const {
    constexpr std::size_t blocks = 24;
    const inference::Run& run = m_evidence.runs().front();
    const inference::MeasuredSeries& series = run.series[m_series[channel]];
    const auto& predicted = m_best.predicted().front()[m_series[channel]];
    const double from_s = run.recording.time_s.front();
    const double block_s = (run.recording.time_s.back() - from_s) / static_cast<double>(blocks);
    std::vector<double> time_s, off(blocks, 0.0), count(blocks, 0.0);
    for (std::size_t k = 0; k < run.rows(); ++k) {
      if (!series.present[k]) continue;
      const auto block = std::min(blocks - 1, static_cast<std::size_t>((run.recording.time_s[k] - from_s) / block_s));
      off[block] += series.values[k] - predicted[k];
      count[block] += 1.0;
    }
    for (std::size_t b = 0; b < blocks; ++b) {
      time_s.push_back(from_s + (static_cast<double>(b) + 0.5) * block_s);
      off[b] /= std::max(1.0, count[b]);
    }
    return stretches(time_s, off);
  }

  /// W while it acts: the mean over time weighted by its size.
  static double watts_while_acting(const std::vector<double>& watts) {
    double squares = 0.0, sum = 0.0, turned = 0.0;
    for (const double w : watts) {
      squares += w * w;
      sum += std::abs(w);
      turned += w * std::abs(w);
    }
    return sum > 0.0 ? std::copysign(squares / sum, turned) : 0.0;
  }

  /// Where it is at least half as large as at its largest.
  static std::vector<std::pair<double, double>> stretches(const std::vector<double>& time_s,
                                                          const std::vector<double>& watts) {
    double largest = 0.0;
    for (const double w : watts) largest = std::max(largest, std::abs(w));
    const double half_s = time_s.size() > 1 ? 0.5 * (time_s[1] - time_s[0]) : 0.0;
    std::vector<std::pair<double, double>> list;
    bool on = false;
    for (std::size_t i = 0; i < watts.size(); ++i) {
      const bool acts = largest > 0.0 && std::abs(watts[i]) >= 0.5 * largest;
      if (acts && !on) list.emplace_back(time_s[i] - half_s, 0.0);
      if (acts) list.back().second = time_s[i] + half_s;
      on = acts;
    }
    for (auto& [from_s, to_s] : list) {
      from_s = std::max(from_s, time_s.front());
      to_s = std::min(to_s, time_s.back());
    }
    return list;
  }

  /// Each further recording predicted from all others: neither explanation has seen it.
  void held_out() {
    for (std::size_t r = 1; r < m_recordings.size(); ++r) {
      std::vector<recording::Recording> others = m_recordings;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(r));
      const auto evidence = std::make_shared<const Evidence>(m_evidence.machine(), others, m_settings);
      HeldOut out;
      out.recording = m_recordings[r].name;
      const auto put = [&](const physics::Machine& machine, std::map<std::string, double>& rms,
                           const recording::Recording& run) {
        const auto result = physics::simulate(machine, run);
        if (!result) return;
        for (const auto& one : physics::compare(result->prediction, m_recordings[r])) rms[one.channel] = one.rms;
      };
      put(m_described, out.nominal, m_recordings[r]);
      put(without_run(m_base, r, evidence), out.refitted, m_recordings[r]);
      put(without_run(m_best, r, evidence), out.explained, driven(m_recordings[r]));
      m_out.held_out.push_back(std::move(out));
    }
  }

  /// What an explanation makes of the recordings but `run`. What happened once is not predicted elsewhere.
  static physics::Machine without_run(const Fit& fit, std::size_t run, const std::shared_ptr<const Evidence>& others) {
    inference::Hypothesis hypothesis = fit.model().hypothesis();
    const int left_out = static_cast<int>(run);
    std::erase_if(hypothesis.effects, [&](const HeldEffect& held) { return held.run == left_out; });
    for (HeldEffect& held : hypothesis.effects) held.run -= held.run > left_out ? 1 : 0;
    Fit rest(std::make_shared<inference::JointModel>(std::move(hypothesis), others), fit.sizes());
    rest.start_from(fit, false);
    rest.fit({others->settings().iterations, true});
    return fitted_description(rest, -1);
  }

  void details() {
    m_out.detectable = detection_limits(m_posterior);
    // Best against what it cannot be told from.
    std::vector<const Fit*> rivals;
    for (const Rival& rival : m_out.ambiguous_with) {
      const auto holds = [&](const Explanation& one) {
        const std::set<Name> names = names_of(one);
        return names.count({rival.id, rival.component, rival.channel}) != 0;
      };
      const auto& all = m_posterior.explanations;
      const auto at = std::find_if(all.begin(), all.end(), holds);
      if (at != all.end() && at->fit.get() != &m_best) rivals.push_back(at->fit.get());
      if (!rivals.empty()) break;
    }
    if (!rivals.empty()) m_out.suggested = suggest_experiment(m_best, rivals);
  }

  void notes() {
    std::vector<Note>& notes = m_out.notes;
    for (Note& one : assumed()) notes.push_back(std::move(one));
    for (Note& one : limits_of(m_described, m_recordings)) notes.push_back(std::move(one));
    const bool blind =
        m_options.details && m_out.verdict == Verdict::consistent && shows_too_little(m_posterior, m_out.detectable);
    if (blind) notes.push_back({NoteCode::shows_too_little, {}});
    const auto add = [&](NoteCode code, const char* key, const std::vector<std::string>& values) {
      if (!values.empty()) notes.push_back({code, {{key, fmt::format("{}", fmt::join(values, ","))}}});
    };
    if (m_out.verdict == Verdict::unexplained || blind) {
      add(NoteCode::inputs_not_logged, "columns", inputs_not_logged());
    } else {
      add(NoteCode::not_recorded, "columns", columns_lacking(m_described, m_recordings));
      if (m_options.details) {
        add(NoteCode::never_driven, "effects", never_driven(m_posterior, m_out.detectable));
        add(NoteCode::cannot_show, "effects", cannot_show(m_out));
      }
      const bool open_door = std::any_of(m_out.effects.begin(), m_out.effects.end(),
                                         [](const FoundEffect& found) { return !found.intervals_s.empty(); });
      if (open_door) add(NoteCode::inputs_not_logged, "columns", inputs_not_logged());
    }
    notes.insert(notes.end(), m_runs.notes.begin(), m_runs.notes.end());
  }

  /// What ran without being logged looks like nothing the library has, or like something that came and went.
  std::vector<std::string> inputs_not_logged() const {
    std::vector<std::string> missing;
    const bool spindle = m_described.rated_speed_rpm() > 0.0;  // a printer is not advised to log its coolant
    for (const char* column : {"coolant_on", "spindle_load_W"}) {
      const bool logged = std::any_of(m_recordings.begin(), m_recordings.end(),
                                      [&](const auto& one) { return one.find(column) != nullptr; });
      if (spindle && !logged) missing.emplace_back(column);
    }
    return missing;
  }

  /// What the networks had to assume, and numbers that the description states too well.
  std::vector<Note> assumed() const {
    std::vector<Note> list;
    const auto& codes = m_best.model().network(0).notes;
    for (const std::string& code : codes) {
      const std::size_t colon = code.find(':');
      const std::string of = colon == std::string::npos ? "" : code.substr(colon + 1);
      for (const NoteCode known :
           {NoteCode::room_given, NoteCode::room_is_initial_temperature, NoteCode::room_not_logged,
            NoteCode::capacity_unknown, NoteCode::conductance_unknown, NoteCode::warm_start}) {
        if (code.substr(0, colon) != diagnosis::name_of(known)) continue;
        const auto before =
            std::find_if(list.begin(), list.end(), [&](const Note& note) { return note.code == known; });
        if (known == NoteCode::capacity_unknown && before != list.end()) {
          before->facts["components"] += ", " + of;
          continue;
        }
        Note note{known, {}};
        if (!of.empty()) note.facts[known == NoteCode::capacity_unknown ? "components" : "component"] = of;
        if (known == NoteCode::room_not_logged) note.facts["column"] = m_described.room.channel;
        if (known == NoteCode::warm_start) {
          const double above_K = physics::start_above_room_K(m_described, of, m_recordings.front());
          const bool sensor_wrong = mass_of({"room_sensor_fault", "", ""}) >= m_settings.named_from;
          if (above_K != 0.0 && !sensor_wrong) note.facts["above"] = fmt::format("{:.1f}", above_K);
        }
        list.push_back(std::move(note));
      }
    }
    if (const auto& raised = m_described.tolerances.raised; !raised.empty())
      list.push_back({NoteCode::tolerances_raised, {{"keys", fmt::format("{}", fmt::join(raised, ","))}}});
    return list;
  }

  void sentences() {
    std::vector<Sentence>& told = m_out.sentences;
    told.push_back(explain_verdict(m_out));
    for (Sentence& one : explain_unexplained(m_out)) told.push_back(std::move(one));
    if (Sentence left = explain_left(m_out); !left.id.empty()) told.push_back(std::move(left));
    for (const Note& note : m_out.notes) {
      // The verdict says that alone.
      if (note.code == NoteCode::described_not_there && m_out.doubtful) continue;
      if (Sentence one = sentence_of(note); !one.id.empty()) told.push_back(std::move(one));
    }
    if (!m_described.tolerances.raised.empty()) told.push_back(explain_raised(m_described.tolerances));
    for (Sentence& one : explain_findings(m_out.findings, m_out.notes)) told.push_back(std::move(one));
  }

  const Posterior& m_posterior;
  const Evidence& m_evidence;
  const DiagnosisSettings& m_settings;
  const Fit& m_best;
  Fit m_base;  // the description alone, as near as it comes
  const physics::Machine& m_described;
  const CheckedRuns& m_runs;
  const std::vector<recording::Recording>& m_recordings;
  const DiagnoseOptions& m_options;
  std::vector<double> m_probability;
  std::vector<std::size_t> m_series;  // of each channel of the answer
  Diagnosis m_out;
};

}  // namespace

Diagnosis assess(const Posterior& posterior, const physics::Machine& described, const CheckedRuns& runs,
                 const DiagnoseOptions& options) {
  return Assessment(posterior, described, runs, options).made();
}

}  // namespace zerodrift::diagnosis::answer
