#include "core/vision/disc.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/vision/circle_finder.h"

namespace zerodrift::vision {
namespace {

constexpr double circle_known_px = 2.0;
constexpr double same_rim_px = 0.4;
constexpr double largest_highlight = 0.4;   // of a ball's radius
constexpr int searched_px = 14;             // beside the circle
constexpr double same_place_px = 0.5;       // good frames stay below 0.2, a gross error begins here
constexpr double same_radius_share = 0.02;  // and
constexpr double same_radius_px = 0.3;
constexpr double another_circle = 0.15;  // of the radius: no target of another size, something else
constexpr double tried_beside_px = 2.0, repeated_px = 0.2;

// Of a ball: a highlight, which need not travel with it, or its rim where shades draw the edges away from that.
bool tells_nothing(const RimCircle& rim, const Eigen::Vector2d& named, const RimCircle& circle) {
  const double apart_px = (rim.middle_px + named - circle.middle_px).norm();
  const double other_px = apart_px + std::abs(rim.radius_px - circle.radius_px);
  if (other_px < circle_known_px) return other_px > same_rim_px;
  return apart_px < rim.radius_px && circle.radius_px < largest_highlight * rim.radius_px;
}

}  // namespace

std::vector<Disc> Disc::all_in(const TemplateSource& source, const std::optional<RimCircle>& rim) {
  const Eigen::Vector2d named(source.point.x_px + source.margin_px, source.point.y_px + source.margin_px);
  std::vector<Disc> out;
  for (const RimCircle& circle : *source.circles) {
    RimCircle narrow = circle;
    narrow.radius_px -= circle_known_px;
    if (shows_a_print(source, narrow) || (rim && tells_nothing(*rim, named, circle))) continue;
    // Among highlights and shades a circle can be laid through chance edges: from a little beside it they make another.
    const auto comes_back = [&](const Eigen::Vector2d& beside) {
      RimCircle start = circle;
      start.middle_px += beside;
      const auto again = circle_at(source.pixels, source.noise_levels, start);
      return again && (again->middle_px - circle.middle_px).norm() < repeated_px &&
             std::abs(again->radius_px - circle.radius_px) < repeated_px;
    };
    if (!comes_back({tried_beside_px, tried_beside_px}) || !comes_back({-tried_beside_px, tried_beside_px})) continue;
    Disc one;
    one.m_circle = circle;
    one.m_circle.middle_px -= named;
    one.m_noise_levels = source.frame_noise_levels;
    one.m_is_rim = rim && std::abs(rim->radius_px - circle.radius_px) < circle_known_px;
    out.push_back(one);
  }
  // Beside the one that is named others may move as they like.
  const auto around = [](const Disc& one) { return one.m_circle.middle_px.norm() < one.m_circle.radius_px; };
  if (std::any_of(out.begin(), out.end(), around)) {
    out.erase(std::remove_if(out.begin(), out.end(), std::not_fn(around)), out.end());
  }
  return out;
}

Disc::Seen Disc::in(const GrayImage& frame, const PixelPoint& named, const Registration& found) const {
  if (found.by_rim && m_is_rim) return Seen::as_expected;
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
  if (!seen || std::abs(seen->radius_px - radius_px) > another_circle * radius_px) return Seen::as_expected;
  if ((seen->middle_px - there.middle_px).norm() > same_place_px) return Seen::elsewhere;
  const double grown_px = std::abs(seen->radius_px - radius_px);
  return grown_px < same_radius_px + same_radius_share * radius_px ? Seen::as_expected : Seen::of_another_size;
}

}  // namespace zerodrift::vision
