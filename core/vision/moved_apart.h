#pragma once
// A region that holds more than the target: what stands behind it may be all that the registration follows. Calibration
// views teach which pixels travel; a target known from one picture only is asked this before a frame is believed.

#include <cstdint>
#include <vector>

#include "core/vision/image.h"
#include "core/vision/registration.h"

namespace zerodrift::vision {

/// True where a part of the region that does not fit at the found place is in the frame at another place, 2 px or more
/// from there, as it looked in the template: nothing then tells which of the two is the target. `usable` as in
/// TemplateSource.
bool moved_apart(const GrayImage& image, const Region& region, const PixelPoint& point,
                 const std::vector<std::uint8_t>& usable, const GrayImage& frame, const Registration& found);

}  // namespace zerodrift::vision
