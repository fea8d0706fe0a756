#pragma once
// The samples of a recording that are compared with a simulation: those that are there and are no spikes.

#include <string>
#include <vector>

#include "core/physics/network.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

struct ChannelSamples {
  std::string channel;
  bool temperature = true;
  std::vector<double> values;  // 0 where absent
  std::vector<bool> present;
  int count = 0;
  double noise = 0.0;  // standard deviation, K or um
};

/// Samples that no fit looks at.
std::vector<bool> spikes_of(const std::vector<double>& values, bool temperature);
/// In the order of the network's observations; a channel that the recording lacks has none.
std::vector<ChannelSamples> samples_of(const recording::Recording& recording, const physics::Network& network);

}  // namespace zerodrift::diagnosis
