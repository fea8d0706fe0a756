#pragma once
// Pictures that must show a machine at rest where its controller says: stamped later than its standstill by the
// camera's latency, after the move to it was seen, and without a change among them.

#include <memory>
#include <vector>

#include "core/acquisition/latency.h"
#include "core/acquisition/stand.h"
#include "core/base/task_context.h"
#include "core/vision/picture_source.h"

namespace zerodrift::vision {

struct StandingLook {
  Region region;  // of the target: what happens elsewhere in the picture does not matter
  acquisition::Latency latency;
  double least_way_mm = 0.1;  // a shorter move need not be seen in the pictures
  int pictures = 4;
  std::chrono::milliseconds picture_timeout{4000};
};

using Pictures = std::vector<std::shared_ptr<const CameraFrame>>;

/// Errors: those of the camera; machine_not_ready when the machine does not stay; target_refused when the pictures do
/// not come to rest, or do not show the move; cancelled.
Result<Pictures> standing_pictures(const PictureSource& camera, const acquisition::Stand& stand,
                                   const StandingLook& look, const TaskContext& context);

/// Their mean, for the template: its noise enters every measurement. image_size when they differ.
Result<GrayImage> mean_of(const Pictures& pictures, const std::string& source);

}  // namespace zerodrift::vision
