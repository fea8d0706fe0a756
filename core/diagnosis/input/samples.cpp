#include "core/diagnosis/input/samples.h"

#include <cmath>

#include "core/diagnosis/inference/settings.h"
#include "core/physics/inputs.h"

namespace zerodrift::diagnosis {

static double noise_of(const std::vector<double>& values, bool temperature) {
  const DiagnosisSettings settings;
  return physics::noise_width(values, temperature ? settings.least_noise_K : settings.least_noise_um);
}

std::vector<bool> spikes_of(const std::vector<double>& values, bool temperature) {
  return physics::spikes(values, noise_of(values, temperature));
}

std::vector<ChannelSamples> samples_of(const recording::Recording& recording, const physics::Network& network) {
  std::vector<ChannelSamples> list;
  for (const auto& seen : network.observations) {
    ChannelSamples samples{seen.channel, seen.temperature, {}, {}, 0, 0.0};
    samples.values.assign(recording.rows(), 0.0);
    samples.present.assign(recording.rows(), false);
    if (const recording::Channel* source = recording.find(seen.channel)) {
      samples.noise = noise_of(source->values, seen.temperature);
      const std::vector<bool> spike = physics::spikes(source->values, samples.noise);
      for (std::size_t k = 0; k < recording.rows(); ++k) {
        if (!std::isfinite(source->values[k]) || spike[k]) continue;
        samples.values[k] = source->values[k];
        samples.present[k] = true;
        ++samples.count;
      }
    }
    list.push_back(std::move(samples));
  }
  return list;
}

}  // namespace zerodrift::diagnosis
