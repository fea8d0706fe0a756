#pragma once
// What the sensors and probes would show: the network's trajectory through the sensors' offsets, lags and gains, the
// elongation, and the structure's own movements; with exact derivatives.

#include <string>
#include <vector>

#include "core/physics/simulator.h"

namespace zerodrift::physics {

struct PredictedChannel {
  std::string channel;
  bool temperature = true;
  std::vector<double> values;
  UnfilledNumbers derivatives;  // [row * columns + column], by parameter value
};

struct Prediction {
  std::size_t rows = 0;
  std::size_t columns = 0;
  std::vector<PredictedChannel> channels;  // in the order of Network::observations
};

Prediction predict(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                   const std::vector<int>& parameters = {}, SimulateOptions options = {});
/// The same from a trajectory already simulated, without derivatives.
Prediction observe(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                   const Trajectory& trajectory);

/// First-order lag of a series that is linear between samples (exact first-order hold), steady at the start.
/// by_tau: its derivative by tau, when wanted.
std::vector<double> lagged(const std::vector<double>& series, const std::vector<double>& time_s, double tau_s,
                           std::vector<double>* by_tau = nullptr);

}  // namespace zerodrift::physics
