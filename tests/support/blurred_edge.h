#pragma once
// Edges of half planes and bands, blurred by a Gaussian.

#include <cmath>
#include <numbers>

namespace zerodrift::test_support {

/// 0 far below the edge, 1 far above it, at the signed distance d; beyond 6 sigma (1e-9) exactly so.
inline double edge(double d, double sigma) {
  if (d > 6.0 * sigma) return 1.0;
  if (d < -6.0 * sigma) return 0.0;
  return 0.5 * std::erfc(-d / (sigma * std::numbers::sqrt2));
}

/// 1 between low and high.
inline double band(double t, double low, double high, double sigma) {
  return edge(t - low, sigma) - edge(t - high, sigma);
}

}  // namespace zerodrift::test_support
