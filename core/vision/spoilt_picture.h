#pragma once
// What spoils the picture of a target that was not measured: too little light, glare, blur. Told by the levels and the
// edges of the picture where the target is, against the template's. It never decides whether a frame is measured, only
// what is said of one that is not: a cover leaves sharp edges and full contrast beside it.

#include "core/vision/target.h"

namespace zerodrift::vision {

/// `why` where the picture tells nothing better. `region` is the target's in `at_rest`; in `frame` it lies
/// `displacement_px` further.
Refusal told_by_the_picture(Refusal why, const GrayImage& frame, const GrayImage& at_rest, const Region& region,
                            const Eigen::Vector2d& displacement_px);

}  // namespace zerodrift::vision
