#pragma once
// A region of bars shows a motion across them and next to nothing of one along them.

#include <string>

#include "core/vision/image.h"

namespace zerodrift::vision {

/// Which motion can hardly be seen, in a sentence; "" where every direction is.
std::string unseen_direction(const GrayImage& image, const Region& region);

}  // namespace zerodrift::vision
