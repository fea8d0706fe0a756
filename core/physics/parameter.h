#pragma once
// A number of the model that a fit may move, with what is known of it beforehand (Gaussian in the value, or in its
// logarithm for what is positive by nature) and the range physics allows.
// z is the standardised unknown: 0 at the mean, 1 one standard deviation up.

#include <algorithm>
#include <cmath>
#include <string>

namespace zerodrift::physics {

/// Where a parameter's value is kept. The same key may be a number of a component and of an effect on it
/// (heat_capacity_J_K of a lump and of a body before its heater): they are two numbers.
enum class Owner {
  description,  // components, sources, couplings
  effect,       // EffectSpec::numbers of effect number `effect`
  recording,    // new in each recording: start temperatures, offsets, the room
};

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

  Owner owner() const {
    if (per_recording) return Owner::recording;
    return effect < 0 ? Owner::description : Owner::effect;
  }
  /// Never outside low to high: at a bound z and back would miss it by a rounding.
  double value_of(double z) const {
    return std::max(low, std::min(logarithmic ? mean * std::exp(sigma * z) : mean + sigma * z, high));
  }
  double z_of(double value) const { return logarithmic ? std::log(value / mean) / sigma : (value - mean) / sigma; }
  /// d value / d z at the value.
  double slope_at(double value) const { return logarithmic ? sigma * value : sigma; }
};

}  // namespace zerodrift::physics
