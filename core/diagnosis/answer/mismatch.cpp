#include "core/diagnosis/answer/mismatch.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/answer/heat_history.h"
#include "core/diagnosis/answer/regime.h"

namespace zerodrift::diagnosis::answer {

using inference::Fit;

namespace {

/// W while it acts: the mean over time weighted by its size.
double watts_while_acting(const std::vector<double>& watts) {
  double squares = 0.0, sum = 0.0, turned = 0.0;
  for (const double w : watts) {
    squares += w * w;
    sum += std::abs(w);
    turned += w * std::abs(w);
  }
  return sum > 0.0 ? std::copysign(squares / sum, turned) : 0.0;
}

/// Where it is at least half as large as at its largest.
std::vector<std::pair<double, double>> stretches(const std::vector<double>& time_s, const std::vector<double>& watts) {
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

/// When the best explanation misses a channel most: by means over a twenty-fourth of the recording.
std::vector<std::pair<double, double>> off_in(const PosteriorSummary& summary, std::size_t of) {
  constexpr std::size_t blocks = 24;
  const inference::Run& run = summary.evidence.runs().front();
  const inference::MeasuredSeries& series = run.series[of];
  const auto& predicted = summary.best.predicted().front()[of];
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

/// What the first recording's series would show without the effects of the best explanation, all else as fitted.
std::vector<std::vector<double>> without_effects(const PosteriorSummary& summary) {
  inference::Hypothesis described = summary.best.model().hypothesis();
  described.effects.clear();
  const auto model = std::make_shared<inference::JointModel>(described, summary.best.model().shared_evidence());
  Fit fit(model, summary.best.sizes());
  fit.start_from(summary.best, false);
  return model->predict(0, fit.z(), {}, nullptr);
}

/// How far the machine as described is off in each of the reported channels, in usual discrepancies: the change that
/// the effects make and what they leave. Where nothing is named, what is left when everything else was fitted to it.
std::vector<double> sizes_of_mismatch(const PosteriorSummary& summary) {
  const std::vector<std::vector<double>> less = without_effects(summary);
  const bool named = !summary.best.model().hypothesis().effects.empty();
  std::vector<double> sizes;
  for (const std::size_t c : summary.reported()) {
    const inference::MeasuredSeries& series = summary.evidence.runs().front().series[c];
    const std::vector<double>& shown = summary.best.predicted().front()[c];
    double squares = 0.0;
    for (std::size_t k = 0; k < shown.size(); ++k)
      squares += std::pow(series.present[k] ? shown[k] - less[c][k] : 0, 2);
    const double change = std::sqrt(squares / std::max(1, series.samples));
    sizes.push_back(std::hypot(change, leftover(named ? summary.best : summary.base, c)) / series.slow);
  }
  return sizes;
}

}  // namespace

void report_mismatch(const PosteriorSummary& summary, Diagnosis& answer) {
  const std::vector<double> size = sizes_of_mismatch(summary);
  std::vector<const ChannelReport*> order;
  for (const ChannelReport& one : answer.channels) order.push_back(&one);
  const auto size_of = [&](const ChannelReport* one) {
    return size[static_cast<std::size_t>(one - answer.channels.data())];
  };
  std::stable_sort(order.begin(), order.end(), [&](auto* a, auto* b) { return size_of(a) > size_of(b); });
  for (const ChannelReport* one : order) {
    if (one->excess_refitted > 1.0 || answer.mismatch.channels.empty())
      answer.mismatch.channels.push_back(one->channel);
  }
  const std::vector<std::size_t> series = summary.reported();
  for (std::size_t i = 0; i < answer.channels.size(); ++i) {
    if (answer.channels[i].verdict == ChannelVerdict::unexplained)
      answer.channels[i].time_s = off_in(summary, series[i]);
  }
  if (!summary.options.details || order.empty()) return;
  const Fit& straight = *summary.posterior.described_straight;
  const std::vector<HeatHistory> histories = heat_histories(straight, 0);
  const HeatHistory* best = nullptr;
  for (const HeatHistory& one : histories) {
    if (best == nullptr || one.best_log_evidence() > best->best_log_evidence()) best = &one;
  }
  if (best == nullptr) return;
  Mismatch& m = answer.mismatch;
  m.component = best->component;
  const std::vector<double>& watts = best->watts[best->best];
  m.missing_heat_W = watts_while_acting(watts);
  m.regime = regime_of({best->time_s, watts}, summary.evidence.runs().front().recording);
  m.time_s = stretches(best->time_s, watts);
  if (best->position_mm.size() > 1) {
    m.scan_position_mm = best->position_mm;
    m.scan_evidence = best->log_evidence;
    m.best_position_mm = best->position_mm[best->best];
    double from = m.best_position_mm, to = from;
    for (std::size_t i = 0; i < best->position_mm.size(); ++i) {
      if (best->log_evidence[i] < best->best_log_evidence() - summary.settings.decisive) continue;
      from = std::min(from, best->position_mm[i]);
      to = std::max(to, best->position_mm[i]);
    }
    m.position_mm = {from, to};
    answer.heat = HeatMap{best->component, best->position_mm, best->time_s, best->watts};
  }
  for (ChannelReport& channel : answer.channels) {
    const physics::Sensor* sensor = summary.described.sensor(channel.channel);
    for (const HeatHistory& one : histories) {
      if (sensor == nullptr || sensor->component != one.component) continue;
      channel.missing_heat_W = watts_while_acting(one.watts[one.best]);
      if (channel.verdict == ChannelVerdict::explained) channel.time_s = stretches(one.time_s, one.watts[one.best]);
    }
  }
}

}  // namespace zerodrift::diagnosis::answer
