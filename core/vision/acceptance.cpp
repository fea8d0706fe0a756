#include "core/vision/acceptance.h"

#include <algorithm>
#include <cmath>

#include "core/vision/registration.h"

namespace zerodrift::vision {
namespace {

constexpr double least_informed = 0.50;
// Under a glaring spot less of the target need be left, when what is left fits almost perfectly and nearly all that is
// missing is known to be the spot.
constexpr double least_informed_in_glare = 0.12;
constexpr double glare_correlation = 0.999;
constexpr double glare_explained = 0.9;
// A pattern that looks the same at any size, as spokes do, fits within the smaller of two targets alone: nothing of
// the rim is left then. Chips leave some of it.
constexpr double least_rim = 0.25;
constexpr double least_fine_correlation = 0.95;
constexpr double largest_contrast = 3.0;
constexpr double largest_linear_in_glare = 0.07;  // a halo bends what little a ball shows
constexpr double largest_growth = 0.015;          // a lamp from another side makes a ball look 0.004 larger
constexpr double some_saturated = 0.005;          // of the pixels: it is glare that spoils the picture
constexpr double accepted_blur_px2 = 12.0;
constexpr double largest_sigma_px = 0.15;  // what is known worse than this is no measurement
constexpr double rough_residual = 2.4;     // standard deviations of shot noise, and
constexpr double rough_to_noise = 1.5;     // times what the template's noise makes it
constexpr double rough_sigma_px = 0.01;
constexpr double hidden_sigma_px = 0.03;
// Where parts of the region move apart, or one of two edges is hidden, the target may seem to be stretched. Bodies that
// warm by tens of kelvin stretch by less than 0.001, and a camera that has come nearer by more is no longer calibrated.
constexpr double largest_stretch = 0.008;
// Of what does not fit: covers and chips stay below 0.25; mazes of thin lines are above 0.34, codes and letters 0.65.
constexpr double another_print = 0.33;
constexpr double least_seen = 0.70;
constexpr double largest_structure = 5.0;  // of the residual: frames that are measured well stay below 1.6

// Of the linear part what is no turn.
double stretch_of(const Registration& r) {
  return (0.5 * (r.linear + r.linear.transpose()) - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff();
}

}  // namespace

Refusal refusal_of(const Registration& r, double coarse_correlation) {
  if (!r.converged) {
    if (coarse_correlation < alike_correlation) return Refusal::missing;
    return r.partly_unlit ? Refusal::occluded : Refusal::too_different;
  }
  const bool fits = r.correlation > least_fine_correlation;
  if (r.seen_share < least_seen) return Refusal::out_of_view;
  if (r.contrast < least_contrast || r.contrast > largest_contrast) {
    return fits ? Refusal::too_different : Refusal::missing;
  }
  if (!fits) return coarse_correlation < alike_correlation ? Refusal::missing : Refusal::wrong_target;
  const bool all_but_glare = r.correlation > glare_correlation && r.inlier_share + r.saturated_share > glare_explained;
  const bool bent_by_glare = all_but_glare && r.saturated_share > some_glare;
  if (linear_change(r) > (bent_by_glare ? largest_linear_in_glare : largest_linear)) return Refusal::wrong_target;
  if (r.parts_apart) return Refusal::moved_apart;
  if (std::abs(r.growth) > largest_growth) return Refusal::wrong_target;
  if (!bent_by_glare && stretch_of(r) > largest_stretch) {
    return r.inlier_share + r.saturated_share < nothing_hidden ? Refusal::occluded : Refusal::wrong_target;
  }
  if (r.structure > largest_structure)
    return r.saturated_share > some_saturated ? Refusal::glare : Refusal::too_different;
  if (r.blur_px2 > accepted_blur_px2) return Refusal::blurred;
  // A cover over much of the target can hold the fit at another place, where it leaves no outliers because it is rough
  // everywhere, or where its levels happen to agree with an edge. What is left under a smaller cover is known ten times
  // better; noise is rough without hiding anything. That a round target hides its turn says nothing against the place.
  const double sigma_px = std::sqrt((r.covariance_px2 - r.unseen_turn_px2).diagonal().maxCoeff());
  if (r.inlier_share + r.saturated_share < nothing_hidden) {
    const bool rough = r.residual > std::max(rough_residual, rough_to_noise * r.expected_residual);
    if (sigma_px > (rough ? rough_sigma_px : hidden_sigma_px)) return Refusal::occluded;
  }
  if (sigma_px > largest_sigma_px) return Refusal::too_different;
  if (r.printed_otherwise > another_print) return Refusal::wrong_target;
  if (r.rim_share < least_rim && !bent_by_glare) return Refusal::wrong_target;
  const bool only_glare = all_but_glare && r.informed_share > least_informed_in_glare;
  if (!only_glare && (r.inlier_share < least_inliers || r.informed_share < least_informed)) {
    if (r.saturated_share > 0.10) return Refusal::glare;
    return coarse_correlation < alike_correlation ? Refusal::missing : Refusal::occluded;
  }
  return Refusal::none;
}

}  // namespace zerodrift::vision
