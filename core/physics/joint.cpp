#include "core/physics/joint.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::physics {
namespace {

constexpr double narrow_cells = 1e-3;  // a plane
/// A reading beside a plane would jump as the plane passes it.
constexpr double narrowest_read = 0.05;

double hat(double u) {
  return std::max(0.0, 1.0 - std::abs(u));
}

/// Integral of the hat from far left to u.
double hat_until(double u) {
  if (u <= -1.0) return 0.0;
  if (u >= 1.0) return 1.0;
  return u < 0.0 ? 0.5 * (1.0 + u) * (1.0 + u) : 1.0 - 0.5 * (1.0 - u) * (1.0 - u);
}

/// Integral of share_before from far left to x.
JointShare share_until(double x, double half) {
  if (x <= -half) return {};
  const double before = std::clamp(0.5 * (x / half + 1.0), 0.0, 1.0);
  if (x >= half) return {x, -1.0, 0.0};
  return {half * before * before, -before, before * (1.0 - before)};
}

}  // namespace

JointShare share_of_face(double u, double half) {
  if (half < narrow_cells) return {hat(u), hat(u) == 0.0 ? 0.0 : u > 0.0 ? -1.0 : 1.0, 0.0};
  JointShare share;
  share.value = (hat_until(u + half) - hat_until(u - half)) / (2.0 * half);
  share.by_place = (hat(u + half) - hat(u - half)) / (2.0 * half);
  share.by_half = ((hat(u + half) + hat(u - half)) / 2.0 - share.value) / half;
  return share;
}

JointShare share_before(double x, double half) {
  const double wide = std::max(half, narrowest_read);
  if (std::abs(x) >= wide) return {x > 0.0 ? 1.0 : 0.0, 0.0, 0.0};
  return {0.5 * (x / wide + 1.0), -0.5 / wide, half < wide ? 0.0 : -0.5 * x / (wide * wide)};
}

JointShare mean_share_before(double x, double half) {
  const double wide = std::max(half, narrowest_read);
  const JointShare to = share_until(x + 0.5, wide), from = share_until(x - 0.5, wide);
  return {to.value - from.value, to.by_place - from.by_place, half < wide ? 0.0 : to.by_half - from.by_half};
}

}  // namespace zerodrift::physics
