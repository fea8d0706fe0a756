#pragma once
// The light of a frame against the template's, told by what stands still beside the target. Inside core/vision only.

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <optional>

#include "core/vision/backdrop.h"

namespace zerodrift::vision::backdrop {

inline constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
inline constexpr float shot_noise_grey = 128.0f;
inline constexpr int clipped_level = 252;

inline bool is_known(float value) {
  return !std::isnan(value);
}

/// The light of a frame against the template's: gain, its slopes, offset.
struct FrameLight {
  Eigen::Vector4d factors{1.0, 0.0, 0.0, 0.0};
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();

  float undone(double level, double x, double y) const;
};

struct LitFrame : RegisteredFrame {
  FrameLight light;
};

/// From what stands still beside the target in both pictures. Nothing when that has changed in itself.
std::optional<FrameLight> light_of(const GrayImage& picture, const Region& sheet, const RegisteredFrame& frame);

}  // namespace zerodrift::vision::backdrop
