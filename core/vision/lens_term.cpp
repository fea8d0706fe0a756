#include "core/vision/lens_term.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr double least_significance = 3.0;  // of the term over its own standard uncertainty
constexpr double well_known_share = 0.1;    // of the prior's uncertainty
// Times the stated uncertainty: as far off is what small moves (+-11 px) tell, rms over six targets of another
// renderer.
constexpr double beyond_stated = 3.0;

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
  const auto trusted = [&](double share) {
    const double total = prior_information + share * information;
    return LensTerm{(prior_information * prior.per_px2 + share * sum) / total, 1.0 / std::sqrt(total)};
  };
  const LensTerm out = trusted(common);
  // Small moves bend the target by less than a blurred outline or what shows behind it does, which no formula for noise
  // knows of. What they say of the lens counts when it stands out, or when they know it far better than everybody does;
  // else it counts with an uncertainty that holds, so that the prior draws most of it back.
  const double significance = std::abs(sum / information) * std::sqrt(common * information);
  const bool well_known = out.sigma_per_px2 < well_known_share * prior.sigma_per_px2;
  if (significance > least_significance || well_known) return out;
  return trusted(common / (beyond_stated * beyond_stated));
}

}  // namespace zerodrift::vision
