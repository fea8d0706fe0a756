#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "tests/support/frame_set.h"

namespace zerodrift::test_support {
namespace {

constexpr double rounding_variance = 1.0 / 12.0;

/// d levels / d shift of the target by a pixel in the picture, by central differences of exact frames.
std::vector<double> derivative(const Session& session, const FrameSpec& spec, Vector2 direction) {
  constexpr double step_px = 0.05;
  const FrameRenderer& renderer = session.renderer;
  const Vector2 seen = renderer.target_point_seen(session.point_px, spec);
  const auto moved = [&](double by_px) {
    FrameSpec other = spec;
    const Vector2 from = renderer.object_from_pixel(seen, spec.camera);
    const Vector2 to =
        renderer.object_from_pixel({seen.x + by_px * direction.x, seen.y + by_px * direction.y}, spec.camera);
    other.target.shift_um.x += to.x - from.x;
    other.target.shift_um.y += to.y - from.y;
    return renderer.levels(other);
  };
  std::vector<double> ahead = moved(step_px);
  const std::vector<double> behind = moved(-step_px);
  for (std::size_t i = 0; i < ahead.size(); ++i) ahead[i] = (ahead[i] - behind[i]) / (2.0 * step_px);
  return ahead;
}

}  // namespace

Vector2 cramer_rao_px(const Session& session, const FrameSpec& spec) {
  const std::vector<double> levels = session.renderer.levels(spec);
  const std::vector<double> by_x = derivative(session, spec, {1.0, 0.0});
  const std::vector<double> by_y = derivative(session, spec, {0.0, 1.0});
  const Vector2 shift = truth_of(session, spec).shift_px;
  const Camera& camera = session.renderer.camera();
  const int x0 = session.roi.x + static_cast<int>(std::lround(shift.x));
  const int y0 = session.roi.y + static_cast<int>(std::lround(shift.y));
  const double gain = std::max(spec.light.gain, 0.01);
  Eigen::Matrix4d information = Eigen::Matrix4d::Zero();
  for (int y = std::max(y0, 0); y < std::min(y0 + session.roi.height, camera.height_px); ++y) {
    for (int x = std::max(x0, 0); x < std::min(x0 + session.roi.width, camera.width_px); ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * camera.width_px + x;
      if (levels[i] >= 254.5) continue;  // saturated: tells nothing
      const double template_level = (levels[i] - spec.light.offset_levels) / gain;
      const double variance = spec.noise.variance(levels[i]) + rounding_variance +
                              gain * gain * (session.template_spec.noise.variance(template_level) + rounding_variance);
      const Eigen::Vector4d row(by_x[i], by_y[i], levels[i], 1.0);
      information += row * row.transpose() / variance;
    }
  }
  const Eigen::Matrix4d covariance = information.inverse();
  return {std::sqrt(covariance(0, 0)), std::sqrt(covariance(1, 1))};
}

}  // namespace zerodrift::test_support
