#pragma once
// Temperatures that are taken as degrees Celsius and do not look like it. A suspicion is for a warning: no value is
// ever converted by the look of it.

#include <cstddef>
#include <vector>

namespace zerodrift::recording {

struct UnitSuspicion {
  std::size_t channel = 0;
  bool kelvin = false;   // or degrees Fahrenheit
  double start_C = 0.0;  // where the channel begins, as it was taken
};

/// `channels` holds the samples of all temperatures of a recording, in degrees Celsius as far as is known.
std::vector<UnitSuspicion> suspected_units(const std::vector<std::vector<double>>& channels);

}  // namespace zerodrift::recording
