#pragma once
// Tells another print from a cover. A target of a few tones, a code or letters, of which part is printed otherwise
// shows there its own tones in the wrong places, darker and brighter ones; what lies on a target has tones of its own.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "core/vision/template_model.h"

namespace zerodrift::vision {

/// Of the template's even pixels that the frame does not show: the share that shows the darkest or the brightest of the
/// template's own tones instead, 0 .. 1. 0 where hardly any are hidden, where all of them are brighter or all darker,
/// and for a target of so many tones that nothing can be told.
/// `tone`: the frame at each pixel of the model, without what happened to the light, grey levels of the template.
/// `hidden`: 1 for each pixel that is seen and does not fit, 0 for those that fit, 2 for those that are not seen.
double printed_otherwise(const TemplateModel& model, const Eigen::VectorXf& tone,
                         const std::vector<std::uint8_t>& hidden);

}  // namespace zerodrift::vision
