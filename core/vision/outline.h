#pragma once
// The outline of a target that stands alone before what surrounds it: what a ball shows within it is the reflection of
// a lamp, which may have moved.

#include <Eigen/Core>
#include <optional>

#include "core/vision/template_model.h"

namespace zerodrift::vision {

/// The source with what lies well within its outline left out; nothing where that would be lost too much, or where
/// there is no outline.
std::optional<TemplateSource> outline_of(const TemplateSource& source, const TemplateModel& model);

/// About which a turn changes the target least, px from the named point: the place that the gradients point to. Of a
/// round one it is the middle, however unevenly it is lit.
Eigen::Vector2d middle_of_turn(const TemplateModel& model);

}  // namespace zerodrift::vision
