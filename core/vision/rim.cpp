#include "core/vision/rim.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/vision/circle_finder.h"
#include "core/vision/rim_fit.h"

namespace zerodrift::vision {
namespace {

using namespace rim_fit;

constexpr double least_fitting = 0.9;
constexpr double rim_noises = 1.5;            // times the noise's deviation: what is left beside a ball, or at its rim
constexpr double rim_levels = 0.7;            // and that,
constexpr double learned_levels = 3.0;        // or that where the backdrop has been learned
constexpr double largest_rim_sigma_px = 0.3;  // a rim that is known worse is no help
constexpr float saturated_from = 250.0f;
constexpr double found_circle_known_px = 2.0;

}  // namespace

struct Rim::Seen {
  TemplateSource source;
  Eigen::Vector2d middle_px;  // from the named point
  Fit fit;                    // in the template's picture
  Ring ring;
};

namespace {

// What is known to stand behind; `corner` is the place in the picture of the source's or the patch's first pixel.
void look_behind(const Backdrop& backdrop, const Eigen::Vector2d& middle_px, const Eigen::Vector2d& corner,
                 const Ring& ring, double contrast, Eigen::VectorXf& behind) {
  const Eigen::Vector2f from = (corner + middle_px).cast<float>();
  behind.resize(ring.count);
  for (int k = 0; k < ring.count; ++k) {
    behind(k) = static_cast<float>(contrast) * backdrop.at(from(0) + ring.x(k), from(1) + ring.y(k));
  }
}

// The spline's values around a middle; false where it reaches beyond the picture.
bool sample_ring(const SplineImage& spline, const Eigen::Vector2d& middle_px, const Ring& ring, std::vector<int>& place,
                 Eigen::VectorXf& level) {
  const Eigen::Vector2d whole = middle_px.array().floor();
  const Eigen::Vector2f part = (middle_px - whole).cast<float>();
  place.resize(static_cast<std::size_t>(ring.count));
  const std::vector<float> right(place.size(), part(0)), down(place.size(), part(1));
  for (int k = 0; k < ring.count; ++k) {
    const int column = static_cast<int>(whole(0)) + static_cast<int>(ring.x(k));
    const int row = static_cast<int>(whole(1)) + static_cast<int>(ring.y(k));
    if (column < 2 || row < 2 || column > spline.width() - SplineImage::reach_after ||
        row > spline.height() - SplineImage::reach_after) {
      return false;
    }
    place[k] = row * spline.width() + column;
  }
  level.resize(ring.count);
  spline.sample(place.data(), right.data(), down.data(), ring.count, level.data());
  return true;
}

}  // namespace

std::optional<Rim> Rim::seen_in(const TemplateSource& source, const Eigen::Matrix2d& blur_px2) {
  const SplineImage spline(blurred(source.pixels, blur_px2));
  const Eigen::Vector2d corner(source.region.x - source.margin_px, source.region.y - source.margin_px);
  std::vector<int> place;
  const Levels levels = [&](const Eigen::Vector2d& middle_px, const Ring& ring, Around& out) {
    if (!sample_ring(spline, middle_px, ring, place, out.level)) return false;
    if (source.backdrop) look_behind(*source.backdrop, middle_px, corner, ring, 1.0, out.behind);
    out.seen.resize(ring.count);
    for (int k = 0; k < ring.count; ++k) out.seen(k) = source.pixels.values[place[k]] < saturated_from;
    return true;
  };
  const double noise = source.noise_levels * std::sqrt(blur_power(blur_px2));
  const auto is_ball = [&](const Fit& one) {
    return one.fitting_share > least_fitting && one.circle.radius_px > least_radius_px &&
           one.deviation < rim_noises * noise + (source.backdrop ? learned_levels : rim_levels) &&
           one.covariance_px2.diagonal().maxCoeff() < largest_rim_sigma_px * largest_rim_sigma_px &&
           !shows_a_print(source, one.circle);
  };
  std::optional<Fit> best;
  std::vector<RimCircle> circles;
  const Eigen::Vector2d named(source.point.x_px + source.margin_px, source.point.y_px + source.margin_px);
  if (source.ball) {
    circles.push_back({source.ball->middle_px + named, source.ball->radius_px, source.ball->blur_px});
  } else {
    circles = source.circles ? *source.circles : circles_in(source);
  }
  for (const RimCircle& circle : circles) {
    // Most targets are no balls, and this needs the circle less well.
    RimCircle narrow = circle;
    narrow.radius_px -= found_circle_known_px;
    if (shows_a_print(source, narrow)) continue;
    best = fit(levels, circle, nullptr, blur_px2);
    if (best && is_ball(*best)) break;
    best.reset();
  }
  if (!best) return std::nullopt;
  return Rim(
      std::make_shared<const Seen>(Seen{source, best->circle.middle_px - named, *best,
                                        Ring(best->circle.radius_px, best->circle.blur_px, Eigen::Matrix2d::Zero())}));
}

const Eigen::Vector2d& Rim::middle_px() const {
  return m_seen->middle_px;
}

RimCircle Rim::circle() const {
  return {m_seen->middle_px, m_seen->fit.circle.radius_px, m_seen->fit.circle.blur_px};
}

std::optional<RimPlace> Rim::find(const FramePatch& patch, const Eigen::Vector2d& expected_px, double contrast,
                                  const Eigen::Matrix2d& blur_px2) const {
  const TemplateSource& source = m_seen->source;
  const Eigen::Vector2d corner(patch.at.x, patch.at.y);
  const Eigen::Vector2d stood = m_seen->fit.circle.middle_px +
                                Eigen::Vector2d(source.region.x - source.margin_px, source.region.y - source.margin_px);
  std::vector<int> place;
  const Levels levels = [&](const Eigen::Vector2d& middle_px, const Ring& ring, Around& out) {
    if (!sample_ring(patch.spline, middle_px, ring, place, out.level)) return false;
    if (source.backdrop) look_behind(*source.backdrop, middle_px, corner, ring, contrast, out.behind);
    out.seen.resize(ring.count);
    for (int k = 0; k < ring.count; ++k) out.seen(k) = patch.state[place[k]] == FramePatch::seen;
    return true;
  };
  RimCircle start = m_seen->fit.circle;
  start.middle_px = stood + expected_px - corner;
  const double wider_px2 = 0.5 * blur_px2.trace();
  start.blur_px = std::sqrt(std::max(start.blur_px * start.blur_px + wider_px2, least_blur_px * least_blur_px));
  const Eigen::Matrix2d uneven_px2 = blur_px2 - wider_px2 * Eigen::Matrix2d::Identity();
  const bool alike = std::abs(start.blur_px - m_seen->ring.blur_px) < other_shape * start.blur_px;
  std::optional<Fit> found = fit(levels, start, alike ? &m_seen->ring : nullptr, patch.blur_px2);
  // What looks like a blur along one direction may be light that has changed, or a lens.
  if (!uneven_px2.isZero()) {
    const std::optional<Fit> other = fit(levels, start, nullptr, patch.blur_px2, uneven_px2);
    if (other && (!found || other->deviation < found->deviation)) found = other;
  }
  if (!found) return std::nullopt;
  RimPlace out;
  out.moved_px = found->circle.middle_px + corner - stood;
  out.covariance_px2 = found->covariance_px2 + m_seen->fit.covariance_px2;
  // A ball keeps its size: what the light did to the radius it may have done to the middle.
  const double grown_px = found->circle.radius_px - m_seen->fit.circle.radius_px;
  out.covariance_px2.diagonal().array() += 0.5 * grown_px * grown_px;
  out.fitting_share = found->fitting_share;
  out.growth = grown_px / m_seen->fit.circle.radius_px;
  return out;
}

}  // namespace zerodrift::vision
