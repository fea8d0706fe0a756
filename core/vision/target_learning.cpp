// What frames in which the target was moved teach about it.

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/vision/acceptance.h"
#include "core/vision/moved_apart.h"
#include "core/vision/target_impl.h"
#include "core/vision/target_mask.h"

namespace zerodrift::vision {
namespace {

constexpr double least_move_px = 2.0;  // a target that stands still does not show what travels with it
constexpr double part_correlation = 0.98;
constexpr double rough_correlation = 0.9;
constexpr double rough_coarse_correlation = 0.5;
constexpr double rough_place_px = 0.3;  // what is known worse is known as well by the coarse search, to half a pixel
constexpr int least_moved = 3;          // frames in which the target is elsewhere
constexpr double noisy_share = 0.06;    // of the gradients' energy: less noise in the template does no harm
constexpr int gathering_rounds = 2;
constexpr double same_blur_px2 = 0.2;  // in other light a lamp may stand elsewhere too
constexpr double same_contrast = 0.1;

// Refused, and yet the place is known well enough to learn from.
bool fits_in_part(const Location& at) {
  return (at.refusal == Refusal::occluded || at.refusal == Refusal::wrong_target) &&
         at.correlation > part_correlation && at.inlier_share > least_inliers;
}

// Though it may be refused.
bool roughly_known(const Location& at, const Registration& fit) {
  const double sigma_px = std::sqrt(fit.covariance_px2.diagonal().maxCoeff());
  return at.correlation > rough_correlation && at.inlier_share > least_inliers && sigma_px < rough_place_px;
}

}  // namespace

// As search, but where something else was followed than what lies around the named point, there: it would be learned as
// what travels.
Location Target::search_at_the_point(const GrayImage& frame, Registration& fit) const {
  std::vector<float> map;
  FramePatches patches(frame);
  Location out = search(patches, &map, &fit);
  fit.residual_map = std::move(map);
  const bool known = out.ok || fits_in_part(out) || roughly_known(out, fit);
  if (!known || m_impl->fine.rim() || fit.by_outline) return out;  // what lies within may be reflected
  const auto there = found_at_the_point(m_impl->fine, m_impl->image, patches, fit);
  if (!there) return out;
  fit = *there;
  out.ok = true;
  out.point = {m_impl->point.x_px + fit.displacement_px(0), m_impl->point.y_px + fit.displacement_px(1)};
  const Eigen::Vector2d zero_px = m_impl->gathered ? m_impl->gathered->zero_px : Eigen::Vector2d::Zero();
  out.x_px = fit.displacement_px(0) - zero_px(0), out.y_px = fit.displacement_px(1) - zero_px(1);
  out.linear = fit.linear;
  return out;
}

// Where a frame shows the target; `rough`: as far as can be told before what stands behind it is known.
std::optional<RegisteredFrame> Target::place_in(const GrayImage& frame, bool rough) const {
  Registration fit;
  const Location at = search_at_the_point(frame, fit);
  if (at.ok) return RegisteredFrame{&frame, {at.x_px, at.y_px}, at.linear, at.lens};
  if (!rough) return std::nullopt;
  RegisteredFrame out{&frame, Eigen::Vector2d::Zero(), Eigen::Matrix2d::Identity(), {}};
  if (roughly_known(at, fit)) {
    out.displacement_px = {at.point.x_px - m_impl->point.x_px, at.point.y_px - m_impl->point.y_px};
    return out;
  }
  const std::vector<Candidate> places = m_impl->coarse.find(frame, 1);
  if (places.empty() || places.front().correlation < rough_coarse_correlation) return std::nullopt;
  out.displacement_px = {places.front().dx_px, places.front().dy_px};
  return out;
}

std::vector<RegisteredFrame> Target::places_in(const std::vector<GrayImage>& frames, bool rough) const {
  std::vector<RegisteredFrame> out;
  for (const GrayImage& frame : frames) {
    if (const auto place = place_in(frame, rough)) out.push_back(*place);
  }
  return out;
}

// What lies over the target in some frames would be learned as what stands behind it.
std::vector<GrayImage> Target::without_covered(const std::vector<GrayImage>& frames) const {
  std::vector<GrayImage> out;
  for (const GrayImage& frame : frames) {
    Registration fit;
    const Location at = search_at_the_point(frame, fit);
    const bool known = at.ok || roughly_known(at, fit);
    if (!known || m_impl->under_a_cover(frame, at, fit.residual_map).empty()) out.push_back(frame);
  }
  return out;
}

// Round after round, from where the target is found with what the one before taught. Before a backdrop that hides how
// much is like the target rough places have to do, until it is found.
Target Target::learned_backdrop(const std::vector<GrayImage>& frames) const {
  const auto moved = [](const RegisteredFrame& one) { return one.displacement_px.norm() > least_move_px; };
  std::vector<RegisteredFrame> registered = places_in(frames, false);
  const bool rough = std::count_if(registered.begin(), registered.end(), moved) < least_moved;
  if (rough) registered = places_in(frames, true);
  Target out = *this;
  for (int round = 0; round < (rough ? 3 : 2); ++round) {
    if (round > 0) registered = out.places_in(frames, rough);
    const auto backdrop = learn_backdrop(m_impl->image, m_impl->region, m_impl->point, registered);
    if (!backdrop) break;
    out = with_backdrop(backdrop);
  }
  return out;
}

// A region with much of what stands still in it looks hidden in part until that has been left out: `in_part` counts
// such frames, where the others are too few to learn from.
Target Target::without_what_stands(const std::vector<GrayImage>& frames, bool in_part, Cover cover) const {
  std::vector<ShownFrame> whole, part;
  int moved = 0, moved_in_part = 0;
  for (const GrayImage& frame : frames) {
    Registration fit;
    const Location at = search_at_the_point(frame, fit);
    ShownFrame shown;
    shown.residual_map = std::move(fit.residual_map);
    if (!at.ok && !fits_in_part(at)) continue;
    if (cover == Cover::possible) shown.under_a_cover = m_impl->under_a_cover(frame, at, shown.residual_map);
    const bool moves =
        std::hypot(at.point.x_px - m_impl->point.x_px, at.point.y_px - m_impl->point.y_px) > least_move_px;
    if (at.ok) whole.push_back(shown), moved += moves;
    part.push_back(std::move(shown)), moved_in_part += moves;
  }
  if (!in_part) return moved >= least_moved ? with_mask(travelling_pixels(m_impl->region, whole)) : *this;
  if (moved >= least_moved || moved_in_part < least_moved) return *this;
  return with_mask(travelling_pixels(m_impl->region, part));
}

// Laid by where the noisy template finds them, the frames share its error; laid once more by where their mean finds
// them, they share that of one frame.
Target Target::gathered_from(const std::vector<GrayImage>& frames) const {
  if (m_impl->fine.model().noise_share < noisy_share) return *this;
  Target out = *this;
  for (int round = 0; round < gathering_rounds; ++round) {
    std::vector<RegisteredFrame> alike;
    for (const GrayImage& frame : frames) {
      const Location at = out.search(frame);
      const bool same = std::abs(at.blur_px2) < same_blur_px2 && std::abs(at.contrast - 1.0) < same_contrast;
      if (!at.ok || !same) continue;
      alike.push_back({&frame, {at.x_px, at.y_px}, at.linear, at.lens});
    }
    auto mean = gathered_pixels(m_impl->image, m_impl->region, m_impl->point, alike, out.backdrop().get());
    if (!mean) return out;
    // What stands behind is told from the template's picture too.
    auto behind = learn_backdrop(m_impl->image, m_impl->region, m_impl->point, alike, &*mean);
    out = with_backdrop(behind ? std::move(behind) : m_impl->backdrop).with_gathered(std::move(*mean));
  }
  return out;
}

Target Target::learned_from(const std::vector<GrayImage>& frames, Cover cover) const {
  const Target seen = without_what_stands(frames, true, cover);
  const std::vector<GrayImage> open = cover == Cover::possible ? seen.without_covered(frames) : frames;
  const Target masked = seen.learned_backdrop(open).without_what_stands(open, false, cover);
  std::vector<LensTerm> lenses;
  for (const GrayImage& frame : frames) {
    const Location at = masked.search(frame);
    if (at.ok) lenses.push_back(at.lens);
  }
  return masked.with_lens(combined(m_lens, lenses)).gathered_from(open);
}

}  // namespace zerodrift::vision
