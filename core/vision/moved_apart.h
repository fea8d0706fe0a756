#pragma once
// A region that holds more than the target: what stands behind it may be all that the registration follows. Calibration
// views teach which pixels travel; a target known from one picture only is asked this before a frame is believed.

#include <optional>

#include "core/vision/frame_patches.h"
#include "core/vision/image.h"
#include "core/vision/registration.h"

namespace zerodrift::vision {

/// True where the part of the template that does not fit at the found place, or what lies around the named point, is in
/// the frame as it was in the template, but elsewhere by more than its uncertainty: the result is then not known to be
/// that of the point. `image` is the template's; `found` comes with its residual map.
bool moved_apart(const Registrar& fine, const GrayImage& image, FramePatches& frame, Registration found);

/// Where what lies around the named point is elsewhere than the target was found, something else was followed: what
/// lies around the point alone then, with the residual map of all where that is.
std::optional<Registration> found_at_the_point(const Registrar& fine, const GrayImage& image, FramePatches& frame,
                                               const Registration& found);

}  // namespace zerodrift::vision
