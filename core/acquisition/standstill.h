#pragma once
// Whether a target stands still in the pictures: consecutive pictures that agree within their stated uncertainty and
// show no trend beyond what heat can make.

#include <array>
#include <span>
#include <string>

#include "core/base/clock.h"

namespace zerodrift::acquisition {

/// The target in one picture, along the two machine axes that its camera sees.
struct Sighting {
  Seconds stamp{0.0};
  std::array<double, 2> um{};
  std::array<double, 2> sigma_um{};  // without what all pictures share
};

struct StandstillRule {
  double agree_um = 1.0;         // pictures of a machine that shakes by less are averaged
  double drift_um_per_s = 0.33;  // of host time, by heat
};

struct StandstillVerdict {
  bool stands = false;
  std::string reason;                // "" when it stands
  std::array<double, 2> trend_um{};  // along each axis over the pictures' time, that may remain in their mean
};

/// Fewer than two sightings stand still: nothing is known of them.
StandstillVerdict standstill(std::span<const Sighting> sightings, const StandstillRule& rule);

}  // namespace zerodrift::acquisition
