#pragma once
// A region that holds more than the target: what stands behind it may be all that the registration follows. Calibration
// views teach which pixels travel; a target known from one picture only is asked this before a frame is believed.

#include "core/vision/image.h"
#include "core/vision/registration.h"

namespace zerodrift::vision {

/// True where the part of the template that does not fit at the found place is in the frame as it was in the template,
/// but elsewhere by more than its uncertainty: nothing then tells which of the two is the target. `image` is the
/// template's; `found` comes with its residual map.
bool moved_apart(const Registrar& fine, const GrayImage& image, const GrayImage& frame, const Registration& found);

}  // namespace zerodrift::vision
