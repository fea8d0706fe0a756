#include "core/diagnosis/answer/assess.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/diagnosis/answer/fitted_description.h"
#include "core/diagnosis/answer/heat_history.h"
#include "core/diagnosis/answer/mistakes.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/locate.h"
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
  Assessment(const Posterior& posterior, const physics::Machine& described,
             const std::vector<recording::Recording>& recordings, const DiagnoseOptions& options)
      : m_posterior(posterior),
        m_evidence(*posterior.evidence),
        m_settings(m_evidence.settings()),
        m_best(*posterior.explanations.front().fit),
        m_base(at_usual_sizes(*posterior.described_straight)),
        m_described(described),
        m_recordings(recordings),
        m_options(options),
        m_probability(probabilities(posterior, m_settings.tempering)) {}

  Diagnosis made() {
    m_out.refined = fitted_description(m_best);
    channels();
    effects();
    rivals();
    verdict();
    mismatch();
    held_out();
    tell_mistakes(m_posterior, m_probability, m_out);
    m_out.sentences.insert(m_out.sentences.begin(), explain_verdict(m_out));
    for (Sentence& one : explain_unexplained(m_out)) m_out.sentences.push_back(std::move(one));
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

  void channels() {
    const recording::Recording& first = m_recordings.front();
    const auto simulated = [&](const physics::Machine& machine, const recording::Recording& run) {
      auto result = physics::simulate(machine, run);
      return result ? result->prediction : recording::Recording{};
    };
    const recording::Recording nominal = simulated(m_described, first);
    const recording::Recording explained = simulated(m_out.refined, driven(first));
    const recording::Recording refitted = simulated(fitted_description(m_base), first);
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
      report.score = before / limit;
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
    const std::set<Name> left_out = details();
    for (std::size_t e = 0; e < held.size(); ++e) {
      const double mass = mass_of(name_of(held[e]));
      if (mass < m_settings.named_from || left_out.count(name_of(held[e])) != 0) continue;
      FoundEffect found;
      const physics::EffectSpec spec = fitted_effect(m_best, e, &found.sigma);
      found.id = spec.id;
      found.component = spec.word_or("component", "");
      found.channel = spec.word_or("channel", "");
      found.parameters = spec.numbers;
      found.words = spec.words;
      found.intervals_s = spec.intervals_s;
      if (held[e].run >= 0) found.recording = m_recordings[static_cast<std::size_t>(held[e].run)].name;
      if (spec.numbers.count("position_mm") != 0) {
        found.position_mm = spec.numbers.at("position_mm");
        found.position_sigma_mm = found.sigma["position_mm"];
      }
      found.confidence = mass;
      found.log_evidence_gain = gain_of(name_of(held[e]));
      ShownBy shown;
      double largest = 0.0;
      for (std::size_t i = 0; i < m_out.channels.size(); ++i) {
        const ChannelReport& channel = m_out.channels[i];
        const double before = leftover(m_base, m_series[i]), after = leftover(m_best, m_series[i]);
        found.contribution[channel.channel] = std::sqrt(std::max(0.0, before * before - after * after));
        const double size =
            found.channel == channel.channel ? 1e300 : found.contribution[channel.channel] / allowed(m_series[i]);
        if (size < largest && !shown.channel.empty()) continue;
        largest = size;
        shown = {channel.channel, channel.rms_refitted, channel.rms_explained, channel.noise};
      }
      found.explanation = explain_effect(found, m_out.time_s.back(), shown);
      m_out.effects.push_back(std::move(found));
    }
    std::stable_sort(m_out.effects.begin(), m_out.effects.end(),
                     [](const auto& a, const auto& b) { return a.log_evidence_gain > b.log_evidence_gain; });
    for (const HeldEffect& one : held) m_out.tried.push_back(one.spec.id);
    std::sort(m_out.tried.begin(), m_out.tried.end());
  }

  /// Effects of the best explanation that only take details which a better form of something else would take as well:
  /// left out one after the other, the least supported first, as long as no channel is left with more.
  std::set<Name> details() const {
    std::vector<Name> order;
    for (const Name& name : names_of(m_posterior.explanations.front())) order.push_back(name);
    std::stable_sort(order.begin(), order.end(), [&](const Name& a, const Name& b) { return gain_of(a) < gain_of(b); });
    std::set<Name> out;
    for (const Name& name : order) {
      out.insert(name);
      if (leaves_more(out)) out.erase(name);
    }
    return out;
  }

  /// Does the best explanation without these effects, fitted anew, leave more of some channel?
  bool leaves_more(const std::set<Name>& without_these) const {
    inference::Hypothesis hypothesis = m_best.model().hypothesis();
    std::erase_if(hypothesis.effects, [&](const HeldEffect& held) { return without_these.count(name_of(held)) != 0; });
    Fit without(std::make_shared<inference::JointModel>(std::move(hypothesis), m_best.model().shared_evidence()),
                m_best.sizes());
    without.start_from(m_best, false);
    without.fit({m_settings.iterations, true});
    for (std::size_t c = 0; c < m_evidence.series(); ++c) {
      if (m_evidence.samples(c) == 0) continue;
      const double with = leftover(m_best, c), less = leftover(without, c);
      if (std::sqrt(std::max(0.0, less * less - with * with)) > m_settings.material_share * leftover(m_base, c))
        return true;
    }
    return false;
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

  void verdict() {
    const auto worst = std::max_element(m_out.channels.begin(), m_out.channels.end(),
                                        [](const auto& a, const auto& b) { return a.score < b.score; });
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
    std::stable_sort(order.begin(), order.end(), [](auto* a, auto* b) { return a->score > b->score; });
    for (const ChannelReport* one : order) {
      if (one->score > 1.0 || m_out.mismatch.channels.empty()) m_out.mismatch.channels.push_back(one->channel);
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
    m.regime = regime_of({best->time_s, watts}, m_evidence.runs().front().recording, "");
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
        if (channel.verdict != ChannelVerdict::consistent) channel.time_s = stretches(one.time_s, one.watts[one.best]);
      }
    }
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

  void held_out() {
    for (std::size_t r = 1; r < m_recordings.size(); ++r) {
      HeldOut out;
      out.recording = m_recordings[r].name;
      const auto put = [&](const physics::Machine& machine, std::map<std::string, double>& rms,
                           const recording::Recording& run) {
        const auto result = physics::simulate(machine, run);
        if (!result) return;
        for (const auto& one : physics::compare(result->prediction, m_recordings[r])) rms[one.channel] = one.rms;
      };
      put(m_described, out.nominal, m_recordings[r]);
      put(fitted_description(m_base, static_cast<int>(r)), out.refitted, m_recordings[r]);
      put(fitted_description(m_best, static_cast<int>(r)), out.explained, driven(m_recordings[r]));
      m_out.held_out.push_back(std::move(out));
    }
  }

  const Posterior& m_posterior;
  const Evidence& m_evidence;
  const DiagnosisSettings& m_settings;
  const Fit& m_best;
  Fit m_base;  // the description alone, as near as it comes
  const physics::Machine& m_described;
  const std::vector<recording::Recording>& m_recordings;
  const DiagnoseOptions& m_options;
  std::vector<double> m_probability;
  std::vector<std::size_t> m_series;  // of each channel of the answer
  Diagnosis m_out;
};

}  // namespace

Diagnosis assess(const Posterior& posterior, const physics::Machine& described,
                 const std::vector<recording::Recording>& recordings, const DiagnoseOptions& options) {
  return Assessment(posterior, described, recordings, options).made();
}

}  // namespace zerodrift::diagnosis::answer
