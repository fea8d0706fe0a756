#pragma once
// What stands behind the target: it shows beside it and through its blurred outline, and does not travel with it. Where
// the outline is all that a target has to show - a ball - it would draw the result by its changing brightness. Learned
// from frames in which the target was moved: every place behind it is seen in some of them.
// A frame that shows the target displaced by d is  target + clear (backdrop(x + d) - backdrop(x)),  with x where the
// template has the pixel and `clear` how much is seen of what stands behind.

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "core/vision/image.h"
#include "core/vision/lens_term.h"
#include "core/vision/spline_image.h"

namespace zerodrift::vision {

inline constexpr int template_margin_px = 12;  // around the region, that is kept of the template

struct Backdrop {
  Region area;        // of the picture
  FloatImage levels;  // there, in the template's light
  FloatImage clear;   // over the region with its margin: 0 where the target is opaque, 1 beside it

  /// At a point of the picture; beyond the area its border is repeated.
  float at(float x_px, float y_px) const;
};

/// A frame and where the target was found in it.
struct RegisteredFrame {
  const GrayImage* image;
  Eigen::Vector2d displacement_px;
  Eigen::Matrix2d linear;
  LensTerm lens;
};

/// Nothing where the frames do not show what stands behind: too few moves, or a region all on the target.
std::shared_ptr<const Backdrop> learn_backdrop(const GrayImage& picture, const Region& region, const PixelPoint& point,
                                               const std::vector<RegisteredFrame>& frames,
                                               const FloatImage* still = nullptr);

}  // namespace zerodrift::vision
