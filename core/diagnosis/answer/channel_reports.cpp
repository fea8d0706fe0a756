#include "core/diagnosis/answer/channel_reports.h"

#include <cmath>

#include "core/diagnosis/answer/fitted_description.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis::answer {

using inference::Fit;

namespace {

/// Where a displacement counts from is new in each recording: the simulation is shifted to the zero of the fit.
recording::Recording at_its_zero(recording::Recording simulation, const Fit& fit) {
  const inference::Run& run = fit.model().evidence().runs().front();
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

}  // namespace

std::vector<ChannelReport> channel_reports(const PosteriorSummary& summary, const physics::Machine& refined) {
  std::vector<ChannelReport> reports;
  const recording::Recording& first = summary.recordings.front();
  const auto simulated = [&](const physics::Machine& machine, const recording::Recording& run) {
    auto result = physics::simulate(machine, run);
    return result ? result->prediction : recording::Recording{};
  };
  const recording::Recording nominal = simulated(summary.described, first);
  const recording::Recording explained = at_its_zero(simulated(refined, summary.driven(first)), summary.best);
  const recording::Recording refitted = at_its_zero(simulated(fitted_description(summary.base), first), summary.base);
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
  for (const std::size_t c : summary.reported()) {
    const inference::MeasuredSeries& series = summary.evidence.runs().front().series[c];
    ChannelReport report;
    report.channel = series.channel;
    report.temperature = series.temperature;
    report.measured = first.find(series.channel)->values;
    report.nominal = values(nominal, series.channel);
    report.refitted = values(refitted, series.channel);
    report.explained = values(explained, series.channel);
    report.rms_nominal = rms(nominal, series.channel);
    report.rms_refitted = rms(refitted, series.channel);
    report.rms_explained = rms(explained, series.channel);
    report.noise = series.white;
    const double limit = summary.allowed(c);
    const double before = leftover(summary.base, c), after = leftover(summary.best, c);
    report.excess_refitted = before / limit;
    report.excess_explained = after / limit;
    constexpr double material = 0.5;  // of what was left, that an explanation has to take
    const bool changed =
        !summary.best.model().hypothesis().effects.empty() && after < material * before && before > series.slow;
    report.verdict = report.excess_explained > 1.0 ? ChannelVerdict::unexplained
                     : changed                     ? ChannelVerdict::explained
                                                   : ChannelVerdict::consistent;
    reports.push_back(std::move(report));
  }
  return reports;
}

}  // namespace zerodrift::diagnosis::answer
