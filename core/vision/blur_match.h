#pragma once
// What to blur, and by how much, so that a template and a frame are alike. Inside core/vision only.

#include <Eigen/Core>

#include "core/vision/registration.h"

namespace zerodrift::vision {

/// Blurs the sharper of the two images until both are alike; false when they are alike enough already or never will be.
/// `extra_px2` is what the solve has seen of how much more the frame is blurred; `may_be_smeared`: along one direction
/// a part of that may be left to the solve, which tells it from a displacement.
bool match_blur(const Eigen::Matrix2d& extra_px2, bool may_be_smeared, ImageSetup& setup);

}  // namespace zerodrift::vision
