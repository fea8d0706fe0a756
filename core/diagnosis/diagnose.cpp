#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>

#include "core/diagnosis/apart.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/experiment.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/locate.h"
#include "core/diagnosis/refined.h"
#include "core/diagnosis/selection.h"
#include "core/diagnosis/thinning.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {
namespace {

using DataPtr = std::shared_ptr<const Dataset>;
using physics::Machine;
using recording::Recording;

double rms_between(const Recording& recording, const std::string& name, const std::vector<double>& predicted) {
  const recording::Channel* seen = recording.find(name);
  if (seen == nullptr || seen->values.size() != predicted.size()) return std::nan("");
  const std::vector<bool> spike = physics::spikes(seen->values, physics::noise_width(seen->values, 0.01));
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < predicted.size(); ++k) {
    if (!std::isfinite(seen->values[k]) || spike[k]) continue;
    sum += (seen->values[k] - predicted[k]) * (seen->values[k] - predicted[k]);
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

/// Excess of a model's residual under other noise assumptions.
Excess excess_under(const Model& model, const Dataset& data) {
  Eigen::VectorXd residual;
  whiten(data, model.prediction(), &residual);
  Excess e;
  e.per_channel = block_excess(data, residual);
  int count = 0;
  for (std::size_t c = 0; c < e.per_channel.size(); ++c) {
    if (data.channels[c].samples == 0) continue;
    e.largest = std::max(e.largest, e.per_channel[c]);
    e.mean += e.per_channel[c];
    ++count;
  }
  e.mean /= std::max(1, count);
  return e;
}

class Diagnoser {
 public:
  Diagnoser(const Machine& machine, const std::vector<Recording>& recordings, const DiagnoseOptions& options,
            const TaskContext& context)
      : m_machine(machine),
        m_recordings(recordings),
        m_fitted(thinned(recordings.front(), most_rows)),
        m_options(options),
        m_context(context) {}

  Result<Diagnosis> run() {
    const auto start = std::chrono::steady_clock::now();
    prepare();
    if (m_data->samples() < 20) {
      return fail(ErrorCode::not_enough_data,
                  {{"what", "the channels that " + m_machine.file + " and " + recording().name + " share"},
                   {"found", std::to_string(m_data->samples()) + " samples"},
                   {"needed", "20"}});
    }
    ZD_TRY(m_selection, select_effects(m_machine, m_data, m_facts, m_limits, m_context));
    ZD_CHECK(choose_drift());
    decide();
    series();
    mismatch();
    effects();
    rivals();
    held_out();
    if (m_options.details) details();
    m_out.sentences.push_back(explain_verdict(m_out));
    m_out.notes = m_selection.base->network().notes;
    notes();
    m_out.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    m_context.progress(1.0, "done");
    return std::move(m_out);
  }

 private:
  static constexpr std::size_t most_rows = 1500;

  /// What is fitted: the first recording, thinned if it is long.
  const Recording& recording() const { return m_fitted; }

  void prepare() {
    const physics::Network network = physics::build_network(m_machine, recording());
    const physics::InputSet inputs = physics::make_inputs(network, recording());
    Dataset data = make_dataset(recording(), network);
    set_timing_noise(data, network, inputs);
    m_data = m_default_data = std::make_shared<Dataset>(std::move(data));
    m_facts = facts_of(m_machine, recording());
    const bool lumps_only = std::all_of(m_machine.components.begin(), m_machine.components.end(),
                                        [](const auto& component) { return component.lump; });
    // Few parts, long chains of small effects: evidence alone decides.
    if (lumps_only) {
      m_limits.most_effects = 5;
      m_limits.excess_must_fall = false;
    }
  }

  /// The slow discrepancy is as large as the evidence says: with the default an imperfect model looks certain of
  /// details.
  Status choose_drift() {
    const Excess excess = excess_of(*m_selection.best);
    if (excess.largest <= 3.0) return {};
    double best_factor = 1.0;
    double best_evidence = m_selection.best->log_evidence_total();
    for (const double factor : {2.0, 4.0, 8.0, 16.0, 32.0}) {
      Model wider(m_selection.best->machine(), std::make_shared<Dataset>(with_drift(*m_default_data, factor)));
      wider.start_from(*m_selection.best, false);
      wider.fit({12, 0.05, true});
      if (wider.log_evidence_total() <= best_evidence + 2.0) continue;
      best_evidence = wider.log_evidence_total();
      best_factor = factor;
    }
    if (best_factor == 1.0) return {};
    m_out.drift_factor = best_factor;
    m_data = std::make_shared<Dataset>(with_drift(*m_default_data, best_factor));
    ZD_TRY(m_selection, reconsider(m_selection, m_data, m_facts, m_limits, m_context));
    return {};
  }

  void decide() {
    const Excess before =
        m_out.drift_factor == 1.0 ? excess_of(*m_selection.base) : excess_under(*m_selection.base, *m_default_data);
    const Excess after =
        m_out.drift_factor == 1.0 ? excess_of(*m_selection.best) : excess_under(*m_selection.best, *m_default_data);
    m_out.excess_before = before.largest;
    m_out.excess_after = after.largest;
    const bool found = !m_selection.effects().empty();
    if (!found) {
      m_out.verdict = after.largest > 2.3 ? Verdict::unexplained : Verdict::consistent;
      m_used = m_selection.base;
    } else {
      const double share = 1.0 - (after.largest - 1.0) / std::max(1e-9, before.largest - 1.0);
      const bool poor = after.largest > 2.3 && share < 0.965;
      m_out.verdict = poor ? Verdict::unexplained : Verdict::missing_effect;
      // A wrong effect can worsen the prediction of another run: it is used only if it really helps.
      const bool helps = after.mean < 0.7 * before.mean;
      m_used = poor && !helps ? m_selection.base : m_selection.best;
    }
    m_out.refined = refined_machine(*m_used);
  }

  void series() {
    m_out.time_s = recording().time_s;
    const physics::Network network = physics::build_network(m_machine, recording());
    const physics::Prediction nominal =
        physics::predict(network, physics::make_inputs(network, recording()), network.start_values());
    const physics::Prediction base = m_selection.base->prediction();
    m_explained = m_selection.best->prediction();
    const Excess before = excess_of(*m_selection.base);
    const Excess after = excess_of(*m_selection.best);
    without_effects();
    for (std::size_t c = 0; c < m_data->channels.size(); ++c) {
      const MeasuredChannel& channel = m_data->channels[c];
      if (channel.samples == 0) continue;
      ChannelReport report;
      report.channel = channel.name;
      report.temperature = channel.temperature;
      report.measured = recording().find(channel.name)->values;
      report.nominal = nominal.channels[c].values;
      report.refitted = base.channels[c].values;
      report.explained = m_explained.channels[c].values;
      report.rms_nominal = rms_between(recording(), channel.name, report.nominal);
      report.rms_refitted = rms_between(recording(), channel.name, report.refitted);
      report.rms_explained = rms_between(recording(), channel.name, report.explained);
      report.noise = channel.white;
      report.excess_refitted = before.per_channel[c];
      report.excess_explained = after.per_channel[c];
      // The channel's mismatch is what the effects change in it, in noise widths; without an effect, what is left over.
      report.score = m_contribution.empty() ? std::sqrt(std::max(0.0, report.excess_refitted))
                                            : m_contribution[c] / std::hypot(channel.white, channel.drift);
      m_out.channels.push_back(std::move(report));
    }
  }

  /// Rms of what all found effects together change in each channel: the best model with and without them.
  void without_effects() {
    if (m_selection.effects().empty()) return;
    Machine bare = refined_machine(*m_selection.best);
    bare.effects.resize(m_selection.described);
    const physics::Network network = physics::build_network(bare, recording());
    const physics::InputSet inputs = physics::make_inputs(network, recording());
    const Machine full = refined_machine(*m_selection.best);
    const physics::Network full_network = physics::build_network(full, recording());
    const physics::Prediction with =
        physics::predict(full_network, physics::make_inputs(full_network, recording()), full_network.start_values());
    const physics::Prediction without = physics::predict(network, inputs, network.start_values());
    m_contribution.assign(m_data->channels.size(), 0.0);
    m_contribution_in_time.assign(recording().rows(), 0.0);
    for (std::size_t c = 0; c < m_contribution.size(); ++c) {
      if (m_data->channels[c].samples == 0) continue;
      const double noise = std::hypot(m_data->channels[c].white, m_data->channels[c].drift);
      for (std::size_t k = 0; k < recording().rows(); ++k) {
        const double d = with.channels[c].values[k] - without.channels[c].values[k];
        m_contribution[c] += d * d / static_cast<double>(recording().rows());
        m_contribution_in_time[k] += d * d / (noise * noise);
      }
      m_contribution[c] = std::sqrt(m_contribution[c]);
    }
  }

  void mismatch() {
    Mismatch& m = m_out.mismatch;
    if (m_out.verdict == Verdict::consistent) return;
    std::vector<const ChannelReport*> order;
    for (const auto& channel : m_out.channels) order.push_back(&channel);
    std::sort(order.begin(), order.end(), [](auto* a, auto* b) { return a->score > b->score; });
    for (const auto* channel : order) {
      if (channel->score > std::max(1.0, 0.15 * order.front()->score)) m.channels.push_back(channel->channel);
    }
    if (m.channels.empty() && !order.empty()) m.channels.push_back(order.front()->channel);
    locate();
    times();
  }

  void locate() {
    Mismatch& m = m_out.mismatch;
    const physics::Sensor* sensor = m_machine.sensor(m.channels.empty() ? "" : m.channels.front());
    for (const auto& component : m_machine.components) {
      if (sensor != nullptr && sensor->component == component.id) m.component = component.id;
      if (component.lump || m.position_mm) continue;
      if (m.component.empty()) m.component = component.id;
      Model nominal(m_machine, m_default_data);
      nominal.fit({0, 0.05, true});
      const SourceScan scan = scan_sources(nominal, component.id);
      m.position_mm = {scan.from_mm, scan.to_mm};
      m.best_position_mm = scan.best_mm;
      m.scan_position_mm = scan.position_mm;
      m.scan_evidence = scan.evidence;
      m.regime = regime_of(scan, recording());
      double sum = 0.0;
      for (const double w : scan.watts) sum += std::abs(w);
      m.missing_heat_W = scan.watts.empty() ? 0.0 : sum / static_cast<double>(scan.watts.size());
      HeatMap heat;
      heat.component = component.id;
      heat.position_mm = scan.position_mm;
      heat.time_s = scan.time_s;
      heat.watts = scan.watts_by_position;
      m_out.heat = std::move(heat);
    }
  }

  /// Stretches of at least a block in which the mismatch is above a third of its largest.
  void times() {
    std::vector<double> size = m_contribution_in_time;
    if (size.empty()) {
      size.assign(recording().rows(), 0.0);
      for (const auto& channel : m_out.channels) {
        for (std::size_t k = 0; k < size.size(); ++k) {
          const double d = (channel.measured[k] - channel.refitted[k]) / std::max(1e-9, channel.noise);
          if (std::isfinite(d)) size[k] += d * d;
        }
      }
    }
    const double largest = *std::max_element(size.begin(), size.end());
    bool inside = false;
    for (std::size_t k = 0; k < size.size(); ++k) {
      const bool above = size[k] > largest / 9.0;
      if (above && !inside) m_out.mismatch.time_s.emplace_back(m_out.time_s[k], m_out.time_s[k]);
      if (above) m_out.mismatch.time_s.back().second = m_out.time_s[k];
      inside = above || (inside && m_out.time_s[k] - m_out.mismatch.time_s.back().second < 900.0);
    }
  }

  void effects() {
    if (m_out.verdict == Verdict::unexplained && m_used == m_selection.base) return;
    const Model& best = *m_selection.best;
    for (const std::size_t index : m_selection.effects()) {
      FoundEffect found;
      const physics::EffectSpec spec = fitted_effect(best, index, &found.sigma);
      found.id = spec.id;
      found.component = spec.word_or("component", "");
      found.channel = spec.word_or("channel", "");
      found.words = spec.words;
      found.parameters = spec.numbers;
      if (spec.numbers.count("position_mm") != 0) {
        found.position_mm = spec.numbers.at("position_mm");
        found.position_sigma_mm = found.sigma["position_mm"];
      }
      found.bounds_reached = best.bounds_reached();
      const auto without = reduced(best, index);
      without->fit({8, 0.05, true});
      found.log_evidence_gain = best.log_evidence() - without->log_evidence();
      std::string worst;
      double before = 0.0, after = 0.0, size = 0.0;
      const physics::Prediction other = without->prediction();
      for (std::size_t c = 0; c < m_data->channels.size(); ++c) {
        const MeasuredChannel& channel = m_data->channels[c];
        if (channel.samples == 0) continue;
        const double left = rms_between(recording(), channel.name, other.channels[c].values);
        const double now = rms_between(recording(), channel.name, m_explained.channels[c].values);
        found.contribution[channel.name] = std::sqrt(std::max(0.0, left * left - now * now));
        const double noise_widths = found.contribution[channel.name] / std::hypot(channel.white, channel.drift);
        if (noise_widths < size && !worst.empty()) continue;
        worst = channel.name;
        size = noise_widths;
        before = left;
        after = now;
      }
      found.confidence = confidence_of(found);
      found.explanation = explain_effect(found, m_out.mismatch, 1.0 - after / std::max(before, 1e-12), before, worst);
      m_out.effects.push_back(std::move(found));
    }
    std::stable_sort(m_out.effects.begin(), m_out.effects.end(),
                     [](const auto& a, const auto& b) { return a.log_evidence_gain > b.log_evidence_gain; });
    place_from_effect();
  }

  /// A named place is better known than the hypothesis-free scan's.
  void place_from_effect() {
    for (const auto& effect : m_out.effects) {
      if (!effect.position_mm) continue;
      const double half_mm = std::max(1.0, 2.0 * effect.position_sigma_mm);
      m_out.mismatch.position_mm = {std::max(0.0, *effect.position_mm - half_mm), *effect.position_mm + half_mm};
      m_out.mismatch.best_position_mm = *effect.position_mm;
      return;
    }
  }

  /// Evidence of the best family of the last level against the other families, tempered (see the proof's reliability).
  double confidence_of(const FoundEffect& found) const {
    constexpr double temperature = 3.0;
    double others = std::exp(-(found.log_evidence_gain - m_limits.first) / temperature);
    std::map<std::string, double> seen;
    const double best = m_selection.best->log_evidence();
    for (const auto& level : m_selection.levels) {
      for (const auto& fit : level) {
        if (fit->machine().effects.size() != m_selection.best->machine().effects.size()) continue;
        const std::string& id = fit->machine().effects.back().id;
        // The same effects found in another order are no rivals of each other.
        const bool own =
            std::any_of(m_selection.best->machine().effects.begin(), m_selection.best->machine().effects.end(),
                        [&](const auto& spec) { return spec.id == id; });
        if (own || seen.count(id) != 0) continue;
        seen[id] = fit->log_evidence();
        others += std::exp(std::min(0.0, fit->log_evidence() - best) / temperature);
      }
    }
    const double poor = m_out.excess_after > 3.0 ? 0.8 : 1.0;
    return poor * 0.99 / (1.0 + others);
  }

  void rivals() {
    if (m_out.verdict != Verdict::missing_effect || m_selection.effects().empty()) return;
    const double best = m_selection.best->log_evidence();
    const double margin = std::max(8.0, 0.02 * (best - m_selection.base->log_evidence()));
    std::vector<std::shared_ptr<Model>> others;
    const bool one_by_one = m_options.details && (m_out.effects.size() > 1 || m_out.drift_factor > 1.0);
    if (one_by_one) {
      for (const std::size_t index : m_selection.effects()) {
        for (auto& fit : rivals_of(*m_selection.best, index, m_facts)) others.push_back(std::move(fit));
      }
    } else {
      const std::size_t size = m_selection.best->machine().effects.size();
      for (const auto& level : m_selection.levels) {
        for (const auto& fit : level) {
          if (fit->machine().effects.size() == size && fit != m_selection.best) others.push_back(fit);
        }
      }
    }
    std::map<std::string, std::shared_ptr<Model>> families;
    for (const auto& fit : others) {
      const std::string& id = fit->machine().effects.back().id;
      const bool own = std::any_of(m_out.effects.begin(), m_out.effects.end(), [&](auto& e) { return e.id == id; });
      if (own || best - fit->log_evidence() > margin) continue;
      auto& kept = families[id];
      if (kept == nullptr || fit->log_evidence() > kept->log_evidence()) kept = fit;
    }
    for (const auto& [id, fit] : families) {
      Rival rival;
      rival.id = id;
      const physics::EffectSpec spec = fitted_effect(*fit, fit->machine().effects.size() - 1);
      rival.component = spec.word_or("component", "");
      rival.channel = spec.word_or("channel", "");
      if (spec.numbers.count("position_mm") != 0) rival.position_mm = spec.numbers.at("position_mm");
      rival.behind = best - fit->log_evidence();
      rival.why = explain_rival(rival);
      m_out.ambiguous_with.push_back(rival);
      m_rivals.push_back(fit);
    }
    std::sort(m_out.ambiguous_with.begin(), m_out.ambiguous_with.end(),
              [](auto& a, auto& b) { return a.behind < b.behind; });
    if (m_out.ambiguous_with.size() > 3) m_out.ambiguous_with.resize(3);
  }

  void held_out() {
    const Machine base = refined_machine(*m_selection.base);
    for (std::size_t i = 1; i < m_recordings.size(); ++i) {
      const Recording& other = m_recordings[i];
      HeldOut result;
      result.recording = other.name;
      const auto put = [&](const Machine& machine, std::map<std::string, double>& target) {
        for (const auto& channel : predict_other(machine, other).channels) {
          const double rms = rms_between(other, channel.channel, channel.values);
          if (std::isfinite(rms)) target[channel.channel] = rms;
        }
      };
      put(m_machine, result.nominal);
      put(base, result.refitted);
      put(m_out.refined, result.explained);
      m_out.held_out.push_back(std::move(result));
    }
  }

  void details() {
    std::map<std::string, Detectable> least;
    for (const auto& candidate : m_selection.screened) {
      if (candidate.detectable <= 0.0) continue;
      const auto& parameters = physics::find_effect(candidate.spec.id)->parameters;
      std::string key;
      for (const auto& p : parameters) {
        if (p.amplitude && candidate.spec.numbers.count(std::string(p.key)) != 0 && key.empty()) key = p.key;
      }
      auto& kept = least[candidate.spec.id];
      if (kept.id.empty() || candidate.detectable < kept.value) kept = {candidate.spec.id, key, candidate.detectable};
    }
    for (auto& [id, detectable] : least) m_out.detectable.push_back(detectable);
    if (!m_rivals.empty()) m_out.suggested = suggest_experiment(*m_selection.best, *m_rivals.front());
  }

  void notes() {
    const bool excited = std::any_of(m_out.channels.begin(), m_out.channels.end(), [](const ChannelReport& c) {
      double low = 1e300, high = -1e300;
      for (const double v : c.measured) {
        if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
      }
      return high - low > 12.0 * c.noise;
    });
    if (!excited) m_out.notes.emplace_back("no_excitation");
    for (const auto& other : m_out.held_out) {
      for (const auto& [channel, rms] : other.explained) {
        for (const auto& report : m_out.channels) {
          if (report.channel == channel && rms > 10.0 * std::max(report.rms_explained, 3.0 * report.noise)) {
            m_out.notes.push_back("held_out_differs:" + other.recording + ":" + channel);
          }
        }
      }
    }
  }

  const Machine& m_machine;
  const std::vector<Recording>& m_recordings;
  const Recording m_fitted;
  DiagnoseOptions m_options;
  const TaskContext& m_context;
  SelectionOptions m_limits;
  DataPtr m_data, m_default_data;
  physics::RunFacts m_facts;
  Selection m_selection;
  std::shared_ptr<Model> m_used;
  physics::Prediction m_explained;
  std::vector<double> m_contribution, m_contribution_in_time;
  std::vector<std::shared_ptr<Model>> m_rivals;
  Diagnosis m_out;
};

}  // namespace

std::string_view name_of(Verdict verdict) {
  return verdict == Verdict::consistent    ? "consistent"
         : verdict == Verdict::unexplained ? "unexplained"
                                           : "missing_effect";
}

Result<Diagnosis> diagnose(const Machine& machine, const std::vector<Recording>& recordings,
                           const DiagnoseOptions& options, const TaskContext& context) {
  if (recordings.empty())
    return fail(ErrorCode::bad_argument, {{"what", "recordings"}, {"found", "none"}, {"expected", "at least one"}});
  std::vector<std::string> warnings;
  for (const auto& recording : recordings) {
    ZD_TRY(auto more, physics::check_recording(machine, recording));
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
  Result<Diagnosis> result = falls_apart(machine) ? diagnose_apart(machine, recordings, options, context)
                                                  : Diagnoser(machine, recordings, options, context).run();
  if (result) result->notes.insert(result->notes.end(), warnings.begin(), warnings.end());
  return result;
}

}  // namespace zerodrift::diagnosis
