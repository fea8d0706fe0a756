#include "core/vision/lens_term.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr double least_significance = 3.0;  // of the term over its own standard uncertainty
constexpr double well_known_share = 0.1;    // of the prior's uncertainty

}  // namespace

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
  if (information <= 0.0) return prior;
  LensTerm out;
  const double total = prior_information + common * information;
  out.per_px2 = (prior_information * prior.per_px2 + common * sum) / total;
  out.sigma_per_px2 = 1.0 / std::sqrt(total);
  // Small moves bend the target by less than a blurred outline or what shows behind it does, which no formula for noise
  // knows of. What they say of the lens counts when it stands out, or when they know it far better than everybody does.
  const double significance = std::abs(sum / information) * std::sqrt(common * information);
  const bool well_known = out.sigma_per_px2 < well_known_share * prior.sigma_per_px2;
  return significance > least_significance || well_known ? out : prior;
}

}  // namespace zerodrift::vision
