#pragma once
// Radial distortion of the lens: distorted radius = radius (1 + per_px2 radius^2). A displaced target is deformed by
// it, and the mean of its pixels moves otherwise than the named point, by some 1e-4 of the way.

#include <optional>
#include <vector>

namespace zerodrift::vision {

struct LensTerm {
  double per_px2 = 0.0;
  double sigma_per_px2 = 1.5e-8;  // 0.24 % at 400 px, as machine-vision lenses have; narrower once it was measured
};

/// What frames say together, each of which was registered with the prior and has updated it; drawn back to the prior
/// where that is not significant.
LensTerm combined(const LensTerm& prior, const std::vector<LensTerm>& updated);

}  // namespace zerodrift::vision
