#include "core/diagnosis/input/left_out.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/diagnosis/description/inner_bodies.h"
#include "core/diagnosis/input/samples.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {
namespace {

constexpr std::size_t fewest = 5;  // samples

std::vector<double> sorted_samples(const std::vector<double>& values) {
  std::vector<double> there;
  std::copy_if(values.begin(), values.end(), std::back_inserter(there), [](double v) { return std::isfinite(v); });
  std::sort(there.begin(), there.end());
  return there;
}

/// Without the outermost 2 %.
double middle_range(const std::vector<double>& sorted) {
  return sorted.empty() ? 0.0 : sorted[sorted.size() * 98 / 100] - sorted[sorted.size() * 2 / 100];
}

/// What it reads all the time, but for a sample or two.
std::optional<double> only_value(const recording::Channel& channel) {
  const std::vector<double> there = sorted_samples(channel.values);
  if (there.size() < fewest || middle_range(there) > 0.0) return std::nullopt;
  return there[there.size() / 2];
}

/// Neighbouring samples differ as a rule: a gauge that resolves its own noise.
bool shows_noise(const recording::Channel& channel) {
  constexpr double as_a_rule = 0.5;
  std::vector<double> there;
  std::copy_if(channel.values.begin(), channel.values.end(), std::back_inserter(there),
               [](double v) { return std::isfinite(v); });
  if (there.size() < fewest) return false;
  std::size_t differ = 0;
  for (std::size_t k = 1; k < there.size(); ++k) differ += there[k] != there[k - 1] ? 1 : 0;
  return static_cast<double>(differ) > as_a_rule * static_cast<double>(there.size() - 1);
}

/// On the line of the two samples before or after it: a bend where the speed changed, and not alone.
bool is_a_bend(const std::vector<double>& values, std::size_t k) {
  constexpr double near = 0.5;  // of what it stands off its neighbours
  if (k < 2 || k + 2 >= values.size()) return false;
  const double off = std::abs(values[k] - 0.5 * (values[k - 1] + values[k + 1]));
  const double before = std::abs(values[k] - (2.0 * values[k - 1] - values[k - 2]));
  const double after = std::abs(values[k] - (2.0 * values[k + 1] - values[k + 2]));
  return std::min(before, after) < near * off;
}

}  // namespace

std::vector<StillGauge> take_out_still_gauges(const physics::Machine& machine, recording::Recording& recording,
                                              const std::vector<recording::Recording>& all) {
  constexpr double far_um = 5.0;  // gauges resolve a micrometre or less
  std::vector<StillGauge> still;
  for (const auto& displacement : machine.displacements) {
    const recording::Channel* channel = recording.find(displacement.channel);
    if (channel == nullptr) continue;
    const auto value = only_value(*channel);
    if (!value) continue;
    const bool reads = std::any_of(all.begin(), all.end(), [&](const recording::Recording& other) {
      const recording::Channel* there = other.find(displacement.channel);
      return there != nullptr && shows_noise(*there);
    });
    using Why = StillGauge::Why;
    still.push_back({displacement.channel, *value, 0.0, reads ? Why::reads_elsewhere : Why::at_rest});
  }
  if (still.empty()) return {};
  const auto simulation = physics::simulate(machine, recording);  // where it cannot be, whoever fits it says why
  for (StillGauge& gauge : still) {
    if (!simulation || has_unknown_heat(machine)) break;
    const recording::Channel* simulated = simulation->prediction.find(gauge.channel);
    if (simulated != nullptr) gauge.simulated_um = middle_range(sorted_samples(simulated->values));
    if (gauge.simulated_um >= far_um) gauge.why = StillGauge::Why::moves_as_described;
  }
  for (const StillGauge& gauge : still) {
    if (gauge.why == StillGauge::Why::at_rest) continue;
    std::erase_if(recording.channels, [&](const auto& channel) { return channel.name == gauge.channel; });
  }
  return still;
}

std::vector<analysis::Finding> spikes_left_out(const physics::Machine& machine, const recording::Recording& recording) {
  constexpr std::ptrdiff_t fewest_told = 3;  // one or two may be a kink where the coolant starts
  std::vector<analysis::Finding> list;
  const auto look_at = [&](const std::string& name, bool temperature) {
    const recording::Channel* channel = recording.find(name);
    if (channel == nullptr) return;
    const std::vector<bool> spike = spikes_of(channel->values, temperature);
    std::ptrdiff_t count = 0;
    for (std::size_t k = 0; k < spike.size(); ++k) count += spike[k] && !is_a_bend(channel->values, k) ? 1 : 0;
    if (count < fewest_told) return;
    list.push_back({analysis::FindingKind::spikes, analysis::FindingAction::repaired, name,
                    fmt::format("{} of {} samples left out", count, channel->values.size())});
  };
  for (const auto& sensor : machine.sensors) look_at(sensor.channel, true);
  for (const auto& displacement : machine.displacements) look_at(displacement.channel, false);
  return list;
}

}  // namespace zerodrift::diagnosis
