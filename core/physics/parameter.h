#pragma once
// A number of the model that a fit may move, with what is known of it beforehand (Gaussian in the value, or in its
// logarithm for what is positive by nature) and the range physics allows.
// z is the standardised unknown: 0 at the mean, 1 one standard deviation up.

#include <cmath>
#include <string>

namespace zerodrift::physics {

struct Parameter {
  std::string key;        // as in the machine description, for example "h_W_m2K"
  std::string component;  // or empty
  std::string channel;    // or empty
  int effect = -1;        // index in Machine::effects, -1: belongs to the base
  double mean = 0.0;
  double sigma = 1.0;
  bool logarithmic = false;
  double low = -1e300;
  double high = 1e300;
  double start = 0.0;      // where the simulation stands without a fit
  bool amplitude = false;  // 0 means: the effect is absent
  bool per_recording = false;
  bool of_sensor = false;  // per recording, but it stays with the sensor: the next recording has much the same

  double value_of(double z) const { return logarithmic ? mean * std::exp(sigma * z) : mean + sigma * z; }
  double z_of(double value) const { return logarithmic ? std::log(value / mean) / sigma : (value - mean) / sigma; }
  /// d value / d z at the value.
  double slope_at(double value) const { return logarithmic ? sigma * value : sigma; }
};

}  // namespace zerodrift::physics
