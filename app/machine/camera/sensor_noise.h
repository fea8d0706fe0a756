#pragma once
// Shot and read noise for a whole frame in about a millisecond: normal deviates by inversion from a table, fed with
// the bits of SplitMix64 (Steele, Lea, Flood 2014). The deviates end at 3.7 sigma; their variance is exactly 1.

#include <cstdint>
#include <span>

namespace zerodrift::machine {

/// levels[i] += sigma_i n_i with sigma_i^2 = read_noise^2 + max(levels[i], 0) / electrons_per_level.
void add_sensor_noise(std::span<float> levels, double read_noise_levels, double electrons_per_level,
                      std::uint64_t seed);

}  // namespace zerodrift::machine
