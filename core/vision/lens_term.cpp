#include "core/vision/lens_term.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::vision {

LensTerm combined(const LensTerm& prior, const std::vector<LensTerm>& updated) {
  const double prior_information = 1.0 / (prior.sigma_per_px2 * prior.sigma_per_px2);
  double information = 0.0;
  double sum = 0.0;
  for (const LensTerm& one : updated) {
    const double own = 1.0 / (one.sigma_per_px2 * one.sigma_per_px2) - prior_information;
    if (!(own > 0.0) || !std::isfinite(own)) continue;
    information += own;
    sum += own * one.per_px2 + (one.per_px2 - prior.per_px2) * prior_information;
  }
  // The template's noise is the same in all frames: they know less together than their number says.
  constexpr double common = 0.5;
  LensTerm out;
  const double total = prior_information + common * information;
  out.per_px2 = (prior_information * prior.per_px2 + common * sum) / total;
  out.sigma_per_px2 = 1.0 / std::sqrt(total);
  return out;
}

}  // namespace zerodrift::vision
