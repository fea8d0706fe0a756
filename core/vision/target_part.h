#pragma once
// A part of a target: which of its pixels belong to it, and the template of those alone. Inside core/vision only.

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "core/vision/registration.h"

namespace zerodrift::vision {

struct TargetPart {
  std::vector<std::uint8_t> pixels;                     // of the region, 1 each
  cv::Rect box;                                         // around them
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();  // of what it shows, from the named point
  double least_share = 1.0;                             // of it that must fit somewhere for that to be its place
};

/// What does not fit, with its surroundings; nothing where that is too little to tell a place.
std::optional<TargetPart> part_that_does_not_fit(const Registrar& fine, const std::vector<float>& residual_map);

/// Around the named point, as much as tells a place; nothing where that is most of the target, or all of it fits.
std::optional<TargetPart> part_at_the_point(const Registrar& fine, const std::vector<float>& residual_map);

/// The template of the part alone, cut to its box.
TemplateSource source_of(const TemplateSource& whole, const TargetPart& part);

}  // namespace zerodrift::vision
