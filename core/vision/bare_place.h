#pragma once
// Whether a frame shows, at a place where the target is sought, nothing but what stands behind it: then it is missing
// there, and need not be looked for in detail. Inside core/vision only.

#include "core/vision/backdrop.h"

namespace zerodrift::vision {

/// The place is the target's, displaced by so much since the template. False where the two are too alike to tell.
bool is_bare(const GrayImage& frame, const GrayImage& picture, const Region& region, const Backdrop& behind, int dx_px,
             int dy_px);

}  // namespace zerodrift::vision
