#include "core/vision/disc.h"

#include <cmath>

#include "core/vision/circle_finder.h"

namespace zerodrift::vision {
namespace {

constexpr double circle_known_px = 2.0;
constexpr int searched_px = 14;             // beside the circle
constexpr double same_place_px = 0.5;       // good frames stay below 0.2, a gross error begins here
constexpr double same_radius_share = 0.02;  // and
constexpr double same_radius_px = 0.3;

}  // namespace

std::optional<Disc> Disc::seen_in(const TemplateSource& source) {
  const Eigen::Vector2d named(source.point.x_px + source.margin_px, source.point.y_px + source.margin_px);
  for (const RimCircle& circle : circles_in(source)) {
    RimCircle narrow = circle;
    narrow.radius_px -= circle_known_px;
    if (!source.ball && shows_a_print(source, narrow)) continue;
    Disc out;
    out.m_circle = circle;
    out.m_circle.middle_px -= named;
    out.m_noise_levels = source.frame_noise_levels;
    return out;
  }
  return std::nullopt;
}

Disc::Seen Disc::in(const GrayImage& frame, const PixelPoint& named, const Registration& found) const {
  const Eigen::Vector2d expected =
      Eigen::Vector2d(named.x_px, named.y_px) + found.displacement_px + found.linear * m_circle.middle_px;
  const double radius_px = m_circle.radius_px * std::sqrt(std::abs(found.linear.determinant()));
  const int reach = static_cast<int>(std::ceil(radius_px)) + searched_px;
  const Region at{static_cast<int>(std::lround(expected(0))) - reach,
                  static_cast<int>(std::lround(expected(1))) - reach, 2 * reach + 1, 2 * reach + 1};
  RimCircle there = m_circle;
  there.middle_px = expected - Eigen::Vector2d(at.x, at.y);
  there.radius_px = radius_px;
  const std::optional<RimCircle> seen = circle_at(crop(frame, at), m_noise_levels, there);
  if (!seen) return Seen::as_expected;
  if ((seen->middle_px - there.middle_px).norm() > same_place_px) return Seen::elsewhere;
  const double grown_px = std::abs(seen->radius_px - radius_px);
  return grown_px < same_radius_px + same_radius_share * radius_px ? Seen::as_expected : Seen::of_another_size;
}

}  // namespace zerodrift::vision
