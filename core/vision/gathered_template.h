#pragma once
// The template with less of its own noise: the mean of frames in which the target was moved, each laid onto the
// template. Inside core/vision only.
// A registration takes its gradients from the template, so that the template's noise counts twice: in the residual and
// in the columns of the solve. Where a target shows little - a ball's outline - the second part is the larger. The mean
// has little noise of its own; where the template stood in it is measured once and taken off every result, so that
// displacements are still those since the template.

#include <optional>
#include <vector>

#include "core/vision/backdrop.h"

namespace zerodrift::vision {

struct GatheredTemplate {
  FloatImage pixels;                                              // the region with template_margin_px around it
  Eigen::Vector2d zero_px = Eigen::Vector2d::Zero();              // where the template's picture shows the target
  Eigen::Matrix2d zero_covariance_px2 = Eigen::Matrix2d::Zero();  // standard uncertainty, squared
};

/// Where the frames differ by more than noise it is the template's own picture. Nothing where too few frames show the
/// target as the template does. The zero is left to be found.
std::optional<FloatImage> gathered_pixels(const GrayImage& picture, const Region& region, const PixelPoint& point,
                                          const std::vector<RegisteredFrame>& frames, const Backdrop* backdrop);

}  // namespace zerodrift::vision
