#pragma once
// The inputs of a run as the network needs them: held inputs (speed, coolant, load, feed, heaters: held from their
// sample to the next) and surroundings (linear between samples), without gaps and isolated spikes; plus the signals
// made of them.

#include <vector>

#include "core/physics/network.h"
#include "core/recording/recording.h"

namespace zerodrift::physics {

struct InputSet {
  std::vector<double> time_s;
  std::vector<std::vector<double>> held;     // [row][index of held channel]
  std::vector<std::vector<double>> linear;   // [row][index of linear channel]
  std::vector<std::vector<double>> signals;  // [row][index of signal]
  std::vector<bool> settled;  // [row] no input of the recording has stepped for a while, nor does it next
  std::size_t rows() const { return time_s.size(); }
};

/// There are inputs, and all of them are zero all the time: nothing heats but the room.
bool nothing_drives(const InputSet& inputs);

InputSet make_inputs(const Network& network, const recording::Recording& recording);

/// Fills gaps linearly and removes isolated spikes (more than 8 noise widths and 2.5 times both neighbours' deviation
/// from the running median of five); sigma is estimated when not given.
std::vector<double> mended(const std::vector<double>& values, const std::vector<double>& time_s);
/// Noise of a slowly varying series: trimmed rms of second differences / sqrt(6), of few samples their median; at least
/// its step / sqrt(12).
double noise_width(const std::vector<double>& values, double floor);
/// Marks isolated spikes, and two in a row.
std::vector<bool> spikes(const std::vector<double>& values, double sigma);

}  // namespace zerodrift::physics
